// SPDX-License-Identifier: BSD-3-Clause
#include "query/query_words.h"

#include <pcl6d/common/number_range.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl6d {
using namespace semantic_map;

namespace {
using Things = std::vector<Entity>;

bool
isAnything(const QueryValue& value)
{
  return !value.quoted && value.text == "*";
}

/** One condition of a query, tested against the key's property. */
class Test {
public:
  Test(const SemanticMap& map,
       const MapQuery& query,
       const QueryCondition& condition,
       const Properties& prototype)
  : map_(map), query_(query), condition_(condition)
  {
    const auto property =
        std::find_if(prototype.begin(), prototype.end(), [&](const Property& p) {
          return p.name == condition.key;
        });
    if (property == prototype.end())
      fail(condition.offset,
           query.subject + " have no '" + condition.key + "', but " + keys(prototype));
    place_ = static_cast<std::size_t>(property - prototype.begin());
    for (const auto& value : condition.values)
      check(*property, value);
  }

  bool
  holds(const Properties& properties) const
  {
    const auto& values = condition_.values;
    const bool is_any =
        std::any_of(values.begin(), values.end(), [&](const auto& value) {
          return matches(properties[place_], value);
        });
    const bool is_unequal = condition_.op == QueryOperator::kNotEqual;
    return is_any != (is_unequal != condition_.negated);
  }

private:
  [[noreturn]] void
  fail(std::size_t offset, const std::string& problem) const
  {
    throw QueryError(query_.text, offset, problem);
  }

  static std::string
  keys(const Properties& properties)
  {
    std::string names;
    for (const auto& property : properties)
      names += (names.empty() ? "" : ", ") + property.name;
    return names;
  }

  bool
  isEquality() const
  {
    return condition_.op == QueryOperator::kEqual ||
           condition_.op == QueryOperator::kNotEqual;
  }

  void
  check(const Property& property, const QueryValue& value) const
  {
    const bool is_number = std::holds_alternative<double>(property.value);
    if (is_number && !value.number)
      fail(value.offset,
           "'" + property.name + "' is a number, got '" + value.text + "'");
    if (!is_number && !isEquality())
      fail(condition_.offset,
           "'" + property.name + "' is no number: only = and != compare with a word");
    if (!std::holds_alternative<Things>(property.value) || value.quoted)
      return;
    if (value.number && !(*value.number >= 0 && *value.number < 1e15 &&
                          std::floor(*value.number) == *value.number))
      fail(value.offset, "expected an id, got '" + value.text + "'");
    const auto entity = entityOf(property, value);
    if (entity && !map_.placeOf(*entity))
      fail(value.offset, "the map has no " + toString(*entity));
  }

  /** \return the entity that a value names by its id */
  static std::optional<Entity>
  entityOf(const Property& property, const QueryValue& value)
  {
    if (value.number && !value.quoted)
      return Entity{property.kind, // no id is below 0
                    *value.number < 0 ? std::numeric_limits<std::size_t>::max()
                                      : clampedTo<std::size_t>(*value.number)};
    return value.quoted ? std::nullopt : value.entity;
  }

  /** \return label, class or file of an entity */
  std::string
  nameOf(const Entity& entity) const
  {
    const std::size_t place = map_.placeOf(entity).value();
    switch (entity.kind) {
    case EntityKind::kPlane:
      return map_.planes[place].best().label;
    case EntityKind::kObject:
      return map_.objects[place].pose.object_class;
    case EntityKind::kScan:
      return map_.scans[place].file;
    case EntityKind::kRoom:
    case EntityKind::kStorey:
      break;
    }
    return toString(entity.kind);
  }

  bool
  matches(const Property& property, const QueryValue& value) const
  {
    if (const auto* number = std::get_if<double>(&property.value))
      return compares(*number, *value.number);
    if (const auto* text = std::get_if<std::string>(&property.value))
      return isAnything(value) ? !text->empty() : *text == value.text;
    const auto entity = entityOf(property, value);
    const Things& things = std::get<Things>(property.value);
    return std::any_of(things.begin(), things.end(), [&](const Entity& thing) {
      return isAnything(value) ||
             (entity ? thing == *entity : nameOf(thing) == value.text);
    });
  }

  bool
  compares(double a, double b) const
  {
    switch (condition_.op) {
    case QueryOperator::kLess:
      return a < b;
    case QueryOperator::kLessEqual:
      return a <= b;
    case QueryOperator::kGreater:
      return a > b;
    case QueryOperator::kGreaterEqual:
      return a >= b;
    case QueryOperator::kEqual:
    case QueryOperator::kNotEqual:
      break;
    }
    return a == b;
  }

  const SemanticMap& map_;
  const MapQuery& query_;
  const QueryCondition& condition_;
  std::size_t place_ = 0; // of the property
};
} // namespace

QueryResult
answerQuery(const SemanticMap& map, const MapQuery& query)
{
  const Properties prototype = prototypeOf(query.subject);
  std::vector<Test> tests;
  for (const auto& condition : query.conditions)
    tests.emplace_back(map, query, condition, prototype);
  QueryResult result;
  result.subject = query.subject;
  for (const auto& property : prototype)
    if (property.in_table)
      result.columns.push_back(property.name);
  for (auto& properties : propertiesOf(map, query.subject))
    if (std::all_of(tests.begin(), tests.end(), [&](const Test& test) {
          return test.holds(properties);
        }))
      result.rows.push_back(std::move(properties));
  return result;
}

} // namespace pcl6d
