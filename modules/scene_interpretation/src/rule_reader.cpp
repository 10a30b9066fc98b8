// SPDX-License-Identifier: BSD-3-Clause
#include "rule_reader.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/name_table.h>
#include <pcl6d/io/text.h>

namespace pcl6d::scene_interpretation {
namespace {
std::string
word(const JsonValue& json)
{
  if (!json.isText() || json.text().empty())
    json.fail(json.excerpt() + " is not a text \"...\"");
  return json.text();
}

double
bound(const JsonValue& json, double open)
{
  if (json.isNull())
    return open;
  if (!json.isNumber())
    json.fail(json.excerpt() + " is neither a number nor null");
  return json.number();
}

Condition
readCondition(Measure measure, const JsonValue& json)
{
  Condition condition;
  if (!json.isPair())
    json.fail(json.excerpt() + " is no range [low, high]");
  const auto range = json.elements();
  const double unit = measure == Measure::kInclination ? kDegree : 1;
  condition.measure = measure;
  condition.low = unit * bound(range[0], condition.low);
  condition.high = unit * bound(range[1], condition.high);
  if (condition.low > condition.high)
    json.fail("the range " + json.excerpt() + " is empty: no plane fits");
  return condition;
}

Orientation
readOrientation(const JsonValue& json)
{
  const std::string name = word(json);
  constexpr Named<Orientation> kNames[] = {{Orientation::kHorizontal, "horizontal"},
                                           {Orientation::kVertical, "vertical"}};
  if (const auto orientation = findNamed(kNames, name))
    return *orientation;
  json.fail("unknown orientation " + text::quoted(name) + ", but must be " +
            listed(kNames, WordList::kOr));
}

SeenFrom
readSeenFrom(const JsonValue& json)
{
  const std::string name = word(json);
  constexpr Named<SeenFrom> kNames[] = {{SeenFrom::kAbove, "above"},
                                        {SeenFrom::kBelow, "below"}};
  if (const auto side = findNamed(kNames, name))
    return *side;
  json.fail("unknown side " + text::quoted(name) + ", but must be " +
            listed(kNames, WordList::kOr));
}

LabelRule
readLabel(const JsonValue& json, const LabelRules& rules)
{
  const JsonValue name = json / "name";
  LabelRule label;
  label.name = word(name);
  if (label.name == "none" || label.name == "*")
    name.fail(text::quoted(label.name) + " is not free to be a label");
  if (rules.find(label.name) < rules.labels.size())
    name.fail("label " + text::quoted(label.name) + " is there already");
  for (const auto& key : json.keys()) {
    if (const auto measure = measureFromName(key))
      label.conditions.push_back(readCondition(*measure, json / key));
    else if (key == "orientation")
      label.orientation = readOrientation(json / key);
    else if (key == "seen_from")
      label.seen_from = readSeenFrom(json / key);
    else if (key != "name")
      json.fail("unknown condition " + text::quoted(key));
  }
  return label;
}

RelationRule
readRelationRule(const JsonValue& json)
{
  RelationRule rule;
  if (json.isText()) {
    const auto relation = relationFromName(json.text());
    if (!relation)
      json.fail("unknown predicate " + text::quoted(json.text()) +
                ", but must be one of " + relationNames());
    rule.relation = *relation;
    return rule;
  }
  if (!json.isObject() || json.keys().size() != 1)
    json.fail(json.excerpt() + R"( is neither "predicate" nor {"all": [...]}, )" +
              R"({"any": [...]} or {"not": ...})");
  const std::string key = json.keys().front();
  if (key == "not") {
    rule.kind = RelationRule::Kind::kNot;
    rule.parts.push_back(readRelationRule(json / key));
    return rule;
  }
  if (key != "all" && key != "any")
    json.fail("unknown key " + text::quoted(key) + ", but must be all, any or not");
  rule.kind = key == "all" ? RelationRule::Kind::kAll : RelationRule::Kind::kAny;
  for (const auto& part : json.elements(key))
    rule.parts.push_back(readRelationRule(part));
  if (rule.parts.empty())
    (json / key).fail("the list of predicates is empty");
  return rule;
}

std::size_t
readLabelName(const JsonValue& json, const LabelRules& rules)
{
  const std::string name = word(json);
  const std::size_t label = rules.find(name);
  if (label == rules.labels.size())
    json.fail("unknown label " + text::quoted(name));
  return label;
}

PairRule
readConstraint(const JsonValue& json, const LabelRules& rules)
{
  json.allow({"between", "holds"});
  const JsonValue between = json / "between";
  if (!between.isPair())
    between.fail(between.excerpt() + " is no pair [label, label]");
  const auto labels = between.elements();
  PairRule pair;
  pair.first = readLabelName(labels[0], rules);
  pair.rule = readRelationRule(json / "holds");
  pair.place = json.place();
  const bool is_any = labels[1].isText() && labels[1].text() == "*";
  pair.second = is_any ? PairRule::kEveryOther : readLabelName(labels[1], rules);
  return pair;
}

NeedRule
readNeed(const JsonValue& json, const LabelRules& rules)
{
  json.allow({"label", "of", "holds"});
  NeedRule need;
  need.label = readLabelName(json / "label", rules);
  need.partner = readLabelName(json / "of", rules);
  need.rule = readRelationRule(json / "holds");
  need.place = json.place();
  return need;
}
} // namespace

void
addRules(const JsonValue& json, LabelRules& rules)
{
  for (const auto& label : json.elements("labels"))
    rules.labels.push_back(readLabel(label, rules));
  if (rules.labels.empty())
    json.fail("there is no label");
  for (const auto& rule : json.elements("constraints"))
    rules.pairs.push_back(readConstraint(rule, rules));
  for (const auto& rule : json.elements("needs"))
    rules.needs.push_back(readNeed(rule, rules));
}

} // namespace pcl6d::scene_interpretation
