// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/suite/suite_json.h"

#include <algorithm>

namespace pcl6d::app {

void
allowMembers(const JsonValue& node, const std::set<std::string>& names)
{
  std::string known;
  for (const auto& name : names)
    known += (known.empty() ? "" : ", ") + name;
  for (const auto& key : node.keys())
    if (names.count(key) == 0)
      node.fail("'" + key + "' is not known; known are " + known);
}

double
numberFrom(const JsonValue& node, double least, const std::string& rule)
{
  node.require(node.isNumber() && node.number() >= least, rule);
  return node.number();
}

SuiteOptions
optionsFrom(const JsonValue& node, const std::set<std::string>& besides)
{
  SuiteOptions options = SuiteOptions::object();
  for (const auto& name : node.keys()) {
    const JsonValue option = node / name;
    if (besides.count(name) > 0)
      continue;
    if (option.json().is_structured())
      option.fail("expected a number, a text, true, false or null");
    options[name] = option.json();
  }
  return options;
}

SuiteOptions
optionsIn(const JsonValue& node, const std::string& name)
{
  return node.has(name) ? optionsFrom(node / name)
                        : SuiteOptions(SuiteOptions::object());
}

void
forEachNamed(const JsonValue& node,
             const std::function<void(const std::string&, const JsonValue&)>& take)
{
  const std::vector<std::string> names = node.keys();
  for (const auto& name : names) {
    const bool unsafe = std::any_of(name.begin(), name.end(), [](unsigned char c) {
      return c < ' ' || c == '/' || c == '|' || c == '"';
    });
    if (name.empty() || name.front() == '.' || name.size() > 100 || unsafe)
      node.fail("'" + name +
                "' is no name: 1 to 100 characters, none of / | \", no dot in front");
    take(name, node / name);
  }
  if (names.empty())
    node.fail("is empty, but at least one entry is needed");
}

namespace {
std::pair<std::size_t, std::size_t>
twoScans(const JsonValue& node)
{
  if (!node.isPair())
    node.fail("expected the indices of two scans");
  const auto indices = node.counts();
  node.require(indices[0] != indices[1], "two different scans");
  return {indices[0], indices[1]};
}

SuiteDamage::Jump
jumpFrom(const JsonValue& node)
{
  if (!node.isPair())
    node.fail("expected the index of a scan and metres");
  const auto parts = node.elements();
  SuiteDamage::Jump jump;
  jump.scan = parts[0].count();
  parts[0].require(jump.scan > 0, "the index of a scan after the first");
  jump.metres = parts[1].number();
  return jump;
}

void
readPoses(const JsonValue& node, SuiteDamage& damage)
{
  if (node.has("odometry_noise"))
    damage.odometry_noise =
        numberFrom(node / "odometry_noise", 0, "a factor of at least 0");
  if (node.has("odometry_scale"))
    damage.odometry_scale =
        numberFrom(node / "odometry_scale", 1e-6, "a factor above 0");
  if (node.has("turn"))
    damage.turn = (node / "turn").number();
  if (node.has("jump"))
    damage.jump = jumpFrom(node / "jump");
  if (node.has("no_poses"))
    damage.no_poses = (node / "no_poses").boolean();
  if (damage.no_poses && damage.changesPoses())
    (node / "no_poses").fail("no poses are left for the remaining fields");
}
} // namespace

SuiteDamage
damageFrom(const std::string& name, const JsonValue& node)
{
  allowMembers(node,
               {"options",
                "odometry_noise",
                "odometry_scale",
                "turn",
                "jump",
                "no_poses",
                "swap",
                "foreign",
                "points",
                "links"});
  SuiteDamage damage;
  damage.name = name;
  damage.text = node.json();
  damage.text.erase("options");
  damage.options = optionsIn(node, "options");
  readPoses(node, damage);
  if (node.has("swap"))
    damage.swap = twoScans(node / "swap");
  if (node.has("foreign"))
    damage.foreign = (node / "foreign").count();
  if (node.has("points")) {
    damage.points = (node / "points").count();
    (node / "points").require(*damage.points >= 3, "at least 3");
  }
  for (const JsonValue& link : node.elements("links"))
    damage.links.push_back(twoScans(link));
  return damage;
}

} // namespace pcl6d::app
