// SPDX-License-Identifier: BSD-3-Clause
#include "rule_reader.h"

#include <algorithm>
#include <array>
#include <functional>

namespace pcl6d::scene_interpretation {
namespace {
constexpr std::size_t kRelations = 11;

// A combination of relations of two planes: from i to j, and from j to i.
struct World {
  std::array<bool, kRelations> forward{};
  std::array<bool, kRelations> backward{};

  void
  set(Relation relation, bool of_i, bool of_j)
  {
    forward[static_cast<std::size_t>(relation)] = of_i;
    backward[static_cast<std::size_t>(relation)] = of_j;
  }

  void
  set(Relation relation, bool of_both)
  {
    set(relation, of_both, of_both);
  }
};

// Every combination of relations that geometry allows, by enumeration.
std::vector<World>
makeWorlds()
{
  std::vector<World> worlds;
  std::size_t code = 0;
  const auto choice = [&code](std::size_t count) {
    const std::size_t digit = code % count;
    code /= count;
    return digit;
  };
  constexpr std::size_t kCodes = 3 * 3 * 2 * 4 * 4 * 2 * 2 * 2;
  for (std::size_t i = 0; i < kCodes; ++i) {
    code = i;
    World world;
    const std::size_t angle = choice(3), height = choice(3), onto = choice(2);
    const std::size_t recessed = choice(4), hinged = choice(4);
    if ((recessed > 0 && onto == 0) || (onto > 0 && angle != 0) ||
        (hinged > 0 && angle == 0))
      continue;
    world.set(Relation::kParallel, angle == 0);
    world.set(Relation::kOrthogonal, angle == 1);
    world.set(Relation::kAbove, height == 0, height == 1);
    world.set(Relation::kUnder, height == 1, height == 0);
    world.set(Relation::kEqualHeight, height == 2);
    world.set(Relation::kOnto, onto == 1);
    world.set(Relation::kRecessed, recessed % 2 == 1, recessed / 2 == 1);
    world.set(Relation::kHinged, hinged % 2 == 1, hinged / 2 == 1);
    world.set(Relation::kStep, choice(2) == 1);
    world.set(Relation::kTouches, choice(2) == 1);
    world.set(Relation::kApart, choice(2) == 1);
    worlds.push_back(world);
  }
  return worlds;
}

bool
isTrue(const RelationRule& rule, const std::array<bool, kRelations>& facts)
{
  const auto part = [&](const RelationRule& r) { return isTrue(r, facts); };
  switch (rule.kind) {
  case RelationRule::Kind::kRelation:
    return facts[static_cast<std::size_t>(rule.relation)];
  case RelationRule::Kind::kAll:
    return std::all_of(rule.parts.begin(), rule.parts.end(), part);
  case RelationRule::Kind::kAny:
    return std::any_of(rule.parts.begin(), rule.parts.end(), part);
  case RelationRule::Kind::kNot:
    break;
  }
  return !part(rule.parts.front());
}

// Whether planes oriented by their labels can have these relations.
bool
fitsOrientations(const World& world, const LabelRule& a, const LabelRule& b)
{
  const auto is = [&](Relation r) {
    return world.forward[static_cast<std::size_t>(r)] ||
           world.backward[static_cast<std::size_t>(r)];
  };
  const bool level_a = a.orientation == Orientation::kHorizontal;
  const bool level_b = b.orientation == Orientation::kHorizontal;
  const bool upright_a = a.orientation == Orientation::kVertical;
  const bool upright_b = b.orientation == Orientation::kVertical;
  if (level_a && level_b && is(Relation::kOrthogonal))
    return false;
  if (((level_a && upright_b) || (upright_a && level_b)) && is(Relation::kParallel))
    return false;
  return !((level_a || level_b) && is(Relation::kHinged));
}

class RuleCheck {
public:
  RuleCheck(const LabelRules& rules, const std::string& file)
  : rules_(rules), file_(file), worlds_(makeWorlds())
  {}

  void
  run()
  {
    for (std::size_t i = 0; i < rules_.labels.size(); ++i)
      checkLabel(rules_.labels[i]);
    for (std::size_t a = 0; a < rules_.labels.size(); ++a)
      for (std::size_t b = a; b < rules_.labels.size(); ++b)
        if (!someWorld(a, b, [](const World&) { return true; }))
          fail("'" + name(a) + "' beside '" + name(b) +
               "' can never be: " + places(a, b));
    checkNeeds();
    checkOrder();
  }

private:
  [[noreturn]] void
  fail(const std::string& message) const
  {
    throw IoFailed(file_ + ": /: rules contradict each other: " + message);
  }

  const std::string&
  name(std::size_t label) const
  {
    return rules_.labels[label].name;
  }

  // Whether the constraints on the pair of labels allow a combination that meets the
  // condition.
  bool
  someWorld(std::size_t a,
            std::size_t b,
            const std::function<bool(const World&)>& condition) const
  {
    return std::any_of(worlds_.begin(), worlds_.end(), [&](const World& world) {
      return fitsOrientations(world, rules_.labels[a], rules_.labels[b]) &&
             condition(world) &&
             std::all_of(
                 rules_.pairs.begin(), rules_.pairs.end(), [&](const PairRule& pair) {
                   return (!pair.binds(a, b) || isTrue(pair.rule, world.forward)) &&
                          (!pair.binds(b, a) || isTrue(pair.rule, world.backward));
                 });
    });
  }

  // The constraints on a pair of labels, for messages.
  std::string
  places(std::size_t a, std::size_t b) const
  {
    std::string text;
    for (const auto& pair : rules_.pairs)
      if (pair.binds(a, b) || pair.binds(b, a))
        text +=
            (text.empty() ? "" : "; ") + pair.place + " (" + toString(pair.rule) + ")";
    return text;
  }

  void
  checkLabel(const LabelRule& label) const
  {
    constexpr double kTenDegrees = 0.17453292519943295;
    constexpr double kUpright = 1.3962634015954636; // 80 deg
    const auto cannot = [&](const std::string& why) {
      fail("label '" + label.name + "' can never be assigned: " + why);
    };
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = -lowest;
    for (const auto& condition : label.conditions) {
      const bool is_inclination = condition.measure == Measure::kInclination;
      const bool is_size = condition.measure != Measure::kBottom &&
                           condition.measure != Measure::kTop &&
                           condition.measure != Measure::kGapToCeiling;
      if (is_size && condition.high < 0)
        cannot(std::string(toString(condition.measure)) + " is never below 0");
      if (is_inclination && label.orientation == Orientation::kHorizontal &&
          condition.low > kTenDegrees)
        cannot("horizontal, and inclined by more than 10 deg");
      if (is_inclination && label.orientation == Orientation::kVertical &&
          condition.high < kUpright)
        cannot("vertical, and inclined by less than 80 deg");
      if (condition.measure == Measure::kBottom)
        lowest = condition.low;
      if (condition.measure == Measure::kTop)
        highest = condition.high;
    }
    if (lowest > highest)
      cannot("the bottom is higher than the top");
  }

  void
  checkNeeds() const
  {
    for (const auto& need : rules_.needs)
      if (!someWorld(need.label, need.partner, [&](const World& world) {
            return isTrue(need.rule, world.forward);
          }))
        fail("label '" + name(need.label) + "' can never be assigned: " + need.place +
             " (" + toString(need.rule) + ") against its constraints " +
             places(need.label, need.partner));
  }

  // Whether the constraints imply that a is always above b.
  bool
  isAlwaysAbove(std::size_t a, std::size_t b) const
  {
    return a != b && !someWorld(a, b, [](const World& world) {
             return !world.forward[static_cast<std::size_t>(Relation::kAbove)];
           });
  }

  void
  checkOrder() const
  {
    const std::size_t count = rules_.labels.size();
    std::vector<std::vector<bool>> above(count, std::vector<bool>(count, false));
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = 0; b < count; ++b)
        above[a][b] = isAlwaysAbove(a, b);
    for (std::size_t via = 0; via < count; ++via)
      for (std::size_t a = 0; a < count; ++a)
        for (std::size_t b = 0; b < count; ++b)
          if (above[a][via] && above[via][b])
            above[a][b] = true;
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = a + 1; b < count; ++b)
        if (above[a][b] && above[b][a])
          fail("'" + name(a) + "' is always above '" + name(b) + "', and that above '" +
               name(a) + "', by way of further labels");
  }

  const LabelRules& rules_;
  const std::string& file_;
  std::vector<World> worlds_;
};
} // namespace

void
checkRules(const LabelRules& rules, const std::string& file)
{
  RuleCheck(rules, file).run();
}

} // namespace pcl6d::scene_interpretation
