// SPDX-License-Identifier: BSD-3-Clause
#include "rule_reader.h"

#include <pcl6d/common/error.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace pcl6d::scene_interpretation {
namespace {
using Json = nlohmann::ordered_json;
constexpr double kDegree = 0.017453292519943295; // [rad]

std::string
shortText(const Json& json)
{
  constexpr std::size_t kLongest = 40;
  const std::string text = json.dump();
  return text.size() > kLongest ? text.substr(0, kLongest) + "..." : text;
}

void
requireObject(const Json& json, const RulePlace& place)
{
  if (!json.is_object())
    place.fail(shortText(json) + " is no object {...}");
}

void
requireKeys(const Json& json,
            const RulePlace& place,
            std::initializer_list<const char*> known)
{
  requireObject(json, place);
  for (const auto& entry : json.items())
    if (std::none_of(
            known.begin(), known.end(), [&](auto* k) { return entry.key() == k; }))
      place.fail("unknown key '" + entry.key() + "'");
}

const Json&
element(const Json& json, const RulePlace& place, const char* key)
{
  const auto found = json.find(key);
  if (found == json.end())
    place.fail(std::string("key '") + key + "' is missing");
  return *found;
}

std::string
word(const Json& json, const RulePlace& place)
{
  if (!json.is_string() || json.get<std::string>().empty())
    place.fail(shortText(json) + " is not a text \"...\"");
  return json.get<std::string>();
}

template <typename Function>
void
forEach(const Json& json, const RulePlace& place, const char* key, Function f)
{
  const auto found = json.find(key);
  if (found == json.end())
    return;
  if (!found->is_array())
    (place / key).fail(shortText(*found) + " is no array [...]");
  for (std::size_t i = 0; i < found->size(); ++i)
    f((*found)[i], place / key / i);
}

double
bound(const Json& json, const RulePlace& place, double open)
{
  if (json.is_null())
    return open;
  if (!json.is_number() || !std::isfinite(json.get<double>()))
    place.fail(shortText(json) + " is neither a number nor null");
  return json.get<double>();
}

Condition
readCondition(Measure measure, const Json& json, const RulePlace& place)
{
  Condition condition;
  if (!json.is_array() || json.size() != 2)
    place.fail(shortText(json) + " is no range [low, high]");
  const double unit = measure == Measure::kInclination ? kDegree : 1;
  condition.measure = measure;
  condition.low = unit * bound(json[0], place, condition.low);
  condition.high = unit * bound(json[1], place, condition.high);
  if (condition.low > condition.high)
    place.fail("the range " + shortText(json) + " is empty, so that no plane fits");
  return condition;
}

Orientation
readOrientation(const Json& json, const RulePlace& place)
{
  const std::string name = word(json, place);
  if (name == "horizontal")
    return Orientation::kHorizontal;
  if (name == "vertical")
    return Orientation::kVertical;
  place.fail("unknown orientation '" + name + "', but must be horizontal or vertical");
}

SeenFrom
readSeenFrom(const Json& json, const RulePlace& place)
{
  const std::string name = word(json, place);
  if (name == "above")
    return SeenFrom::kAbove;
  if (name == "below")
    return SeenFrom::kBelow;
  place.fail("unknown side '" + name + "', but must be above or below");
}

LabelRule
readLabel(const Json& json, const RulePlace& place, const LabelRules& rules)
{
  requireObject(json, place);
  LabelRule label;
  label.name = word(element(json, place, "name"), place / "name");
  if (label.name == "none" || label.name == "*")
    (place / "name").fail("'" + label.name + "' is not free to be a label");
  if (rules.find(label.name) < rules.labels.size())
    (place / "name").fail("label '" + label.name + "' is there already");
  for (const auto& entry : json.items()) {
    const RulePlace here = place / entry.key();
    const auto measure = measureFromName(entry.key());
    if (measure)
      label.conditions.push_back(readCondition(*measure, entry.value(), here));
    else if (entry.key() == "orientation")
      label.orientation = readOrientation(entry.value(), here);
    else if (entry.key() == "seen_from")
      label.seen_from = readSeenFrom(entry.value(), here);
    else if (entry.key() != "name")
      place.fail("unknown condition '" + entry.key() + "'");
  }
  return label;
}

RelationRule
readRelationRule(const Json& json, const RulePlace& place)
{
  RelationRule rule;
  if (json.is_string()) {
    const auto relation = relationFromName(json.get<std::string>());
    if (!relation)
      place.fail("unknown predicate '" + json.get<std::string>() +
                 "', but must be one of " + relationNames());
    rule.relation = *relation;
    return rule;
  }
  if (!json.is_object() || json.size() != 1)
    place.fail(shortText(json) + R"( is neither "predicate" nor {"all": [...]}, )" +
               R"({"any": [...]} or {"not": ...})");
  const std::string key = json.begin().key();
  if (key == "not") {
    rule.kind = RelationRule::Kind::kNot;
    rule.parts.push_back(readRelationRule(json.begin().value(), place / key));
    return rule;
  }
  if (key != "all" && key != "any")
    place.fail("unknown key '" + key + "', but must be all, any or not");
  rule.kind = key == "all" ? RelationRule::Kind::kAll : RelationRule::Kind::kAny;
  forEach(json, place, key.c_str(), [&](const Json& part, const RulePlace& here) {
    rule.parts.push_back(readRelationRule(part, here));
  });
  if (rule.parts.empty())
    (place / key).fail("the list of predicates is empty");
  return rule;
}

std::size_t
readLabelName(const Json& json, const RulePlace& place, const LabelRules& rules)
{
  const std::string name = word(json, place);
  const std::size_t label = rules.find(name);
  if (label == rules.labels.size())
    place.fail("unknown label '" + name + "'");
  return label;
}

void
addConstraint(const Json& json, const RulePlace& place, LabelRules& rules)
{
  requireKeys(json, place, {"between", "holds"});
  const Json& between = element(json, place, "between");
  if (!between.is_array() || between.size() != 2)
    (place / "between").fail(shortText(between) + " is no pair [label, label]");
  PairRule pair;
  pair.first = readLabelName(between[0], place / "between" / 0, rules);
  pair.rule = readRelationRule(element(json, place, "holds"), place / "holds");
  pair.place = place.file + ": " + place.pointer;
  pair.second = between[1] == "*"
                    ? PairRule::kEveryOther
                    : readLabelName(between[1], place / "between" / 1, rules);
  rules.pairs.push_back(pair);
}

void
addNeed(const Json& json, const RulePlace& place, LabelRules& rules)
{
  requireKeys(json, place, {"label", "of", "holds"});
  NeedRule need;
  need.label = readLabelName(element(json, place, "label"), place / "label", rules);
  need.partner = readLabelName(element(json, place, "of"), place / "of", rules);
  need.rule = readRelationRule(element(json, place, "holds"), place / "holds");
  need.place = place.file + ": " + place.pointer;
  rules.needs.push_back(need);
}
} // namespace

void
RulePlace::fail(const std::string& message) const
{
  throw IoFailed(file + ": " + (pointer.empty() ? "/" : pointer) + ": " + message);
}

void
addRules(const Json& json, const RulePlace& place, LabelRules& rules)
{
  forEach(json, place, "labels", [&](const Json& label, const RulePlace& here) {
    rules.labels.push_back(readLabel(label, here, rules));
  });
  if (rules.labels.empty())
    place.fail("there is no label");
  forEach(json, place, "constraints", [&](const Json& rule, const RulePlace& here) {
    addConstraint(rule, here, rules);
  });
  forEach(json, place, "needs", [&](const Json& rule, const RulePlace& here) {
    addNeed(rule, here, rules);
  });
}

} // namespace pcl6d::scene_interpretation
