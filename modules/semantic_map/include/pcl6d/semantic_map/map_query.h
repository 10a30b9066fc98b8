// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/common/export.h>
#include <pcl6d/semantic_map/semantic_map.h>

#include <cstddef>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/** \file
 * A small query language for maps (book 7.3): \code
 * query     = subject { condition }
 * subject   = "objects" | "planes" | "rooms" | "storeys" | "scans" | "links" | "relations"
 * condition = [ "not" ] key op value { "," value }
 * op        = "=" | "!=" | "<" | "<=" | ">" | ">="
 * value     = number | word | "'" text "'" | '"' text '"' | kind ":" id | "*"
 * \endcode
 * Every condition must hold, and of several values at least one. Keys: propertiesOf().
 * A key that refers to entities, such as `on`, `room` or `seen`, compares with an id
 * (`on=plane:1`, `room=2`), with a label or class (`on=floor`, `next_to=table`), or
 * with `*`, any entity. In quotes a backslash keeps the next character. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief Invalid query; the message names column, found text and expected text.
 * \ingroup semantic_map */
class QueryError : public BadArgument {
public:
  QueryError(const std::string& query, std::size_t offset, const std::string& problem);

  /** \return the query and, below it, a mark under the error, two lines */
  const std::string&
  marked() const
  {
    return marked_;
  }

private:
  std::string marked_;
};

enum class QueryOperator {
  kEqual,
  kNotEqual,
  kLess,
  kLessEqual,
  kGreater,
  kGreaterEqual
};

/** \brief A value to compare with. */
struct QueryValue {
  std::string text;             ///< as written, without quotes
  bool quoted = false;          ///< then it is only text
  std::optional<double> number; ///< if the text is a number
  std::optional<Entity> entity; ///< if the text names an entity
  std::size_t offset = 0;       ///< position in the query
};

struct QueryCondition {
  bool negated = false;
  std::string key;
  QueryOperator op = QueryOperator::kEqual;
  std::vector<QueryValue> values; ///< at least one
  std::size_t offset = 0;         ///< of the key in the query
};

/** \brief A parsed query. */
struct MapQuery {
  std::string text;
  std::string subject; ///< in the plural
  std::vector<QueryCondition> conditions;
};

/** \throws QueryError */
MapQuery
parseQuery(const std::string& text);

/** \brief A value of a property: number, text, or entities of the map. */
using PropertyValue = std::variant<double, std::string, std::vector<Entity>>;

struct Property {
  std::string name;
  PropertyValue value;
  EntityKind kind = EntityKind::kPlane; ///< of entities: the kind of a bare id
  bool in_table = false;                ///< worth a column
};

/** \brief Every property of an entity that a query may use, in order. */
using Properties = std::vector<Property>;

/** \brief The answer to a query. */
struct QueryResult {
  std::string subject;
  std::vector<Properties> rows;     ///< entities that meet the conditions, in the map's
                                    ///< order
  std::vector<std::string> columns; ///< of a table
};

/** \brief Finds the entities that meet the conditions of a query.
 * \throws QueryError an unknown key, a value of another kind than the key's, an
 * operator that the key does not have, or an entity that is not in the map */
QueryResult
answerQuery(const SemanticMap& map, const MapQuery& query);

/** \brief Writes the answer as a table with a header line; writes no header without
 * rows. */
void
writeTable(std::ostream& stream, const QueryResult& result);

/** \brief Writes the answer as JSON: `subject`, `count`, `results` with every property;
 * entities of the map as "plane:12". */
void
writeJson(std::ostream& stream, const QueryResult& result);

} // namespace pcl6d
