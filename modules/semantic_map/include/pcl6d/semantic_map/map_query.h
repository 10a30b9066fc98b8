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
 * A small language for questions to a map (book 7.3): \code
 * query     = subject { condition }
 * subject   = "objects" | "planes" | "rooms" | "storeys" | "scans" | "links" | "relations"
 * condition = [ "not" ] key op value { "," value }
 * op        = "=" | "!=" | "<" | "<=" | ">" | ">="
 * value     = number | word | "'" text "'" | '"' text '"' | kind ":" id | "*"
 * \endcode
 * All conditions must hold, of several values one. What the keys are: propertiesOf(). A
 * key that names other things, such as `on`, `room` or `seen`, compares with an id
 * (`on=plane:1`, `room=2`), with a label or class (`on=floor`, `next_to=table`), or with
 * `*`, anything. In quotes a backslash keeps the next character. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief A query that is none; the message names column, what was found and what was
 * expected. \ingroup semantic_map */
class QueryError : public BadArgument {
public:
  QueryError(const std::string& query, std::size_t offset, const std::string& problem);

  /** \return the query and, below it, a mark under the place, two lines */
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

/** \brief What a condition compares with. */
struct QueryValue {
  std::string text;             ///< as written, without quotes
  bool quoted = false;          ///< then it is text and nothing else
  std::optional<double> number; ///< if it is one
  std::optional<Entity> entity; ///< if it names one
  std::size_t offset = 0;       ///< place in the query
};

struct QueryCondition {
  bool negated = false;
  std::string key;
  QueryOperator op = QueryOperator::kEqual;
  std::vector<QueryValue> values; ///< at least one
  std::size_t offset = 0;         ///< of the key in the query
};

/** \brief A query as it was read. */
struct MapQuery {
  std::string text;
  std::string subject; ///< in the plural
  std::vector<QueryCondition> conditions;
};

/** \throws QueryError */
MapQuery
parseQuery(const std::string& text);

/** \brief A value of a property: number, text, or things of the map. */
using PropertyValue = std::variant<double, std::string, std::vector<Entity>>;

struct Property {
  std::string name;
  PropertyValue value;
  EntityKind kind = EntityKind::kPlane; ///< of things: what a bare id means
  bool in_table = false;                ///< worth a column
};

/** \brief All that can be asked about a thing, in order. */
using Properties = std::vector<Property>;

/** \brief The answer to a query. */
struct QueryResult {
  std::string subject;
  std::vector<Properties> rows; ///< of all that meet the conditions, in the map's order
  std::vector<std::string> columns; ///< of a table
};

/** \brief Finds what meets the conditions of a query.
 * \throws QueryError no such key, a value of another kind than the key's, an operator that
 * it does not have, or a thing that the map has not */
QueryResult
answerQuery(const SemanticMap& map, const MapQuery& query);

/** \brief Writes the answer as a table with a line of names above; none for no rows. */
void
writeTable(std::ostream& stream, const QueryResult& result);

/** \brief Writes the answer as JSON: `subject`, `count`, `results`, each with all its
 * properties; things of the map as "plane:12". */
void
writeJson(std::ostream& stream, const QueryResult& result);

} // namespace pcl6d
