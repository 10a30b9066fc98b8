// SPDX-License-Identifier: BSD-3-Clause
#include "rule_reader.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/name_table.h>
#include <pcl6d/io/text.h>

#include <algorithm>

namespace pcl6d {
using namespace scene_interpretation;

namespace {
void
checkHeader(const JsonValue& json)
{
  if (!json.isObject())
    json.fail("no object {...} of rules");
  json.allow({"schema_version", "name", "extends", "labels", "constraints", "needs"});
  if (json.has("schema_version")) {
    const JsonValue version = json / "schema_version";
    version.require(version.isNumber() && version.number() == 1, "1");
  }
  for (const char* key : {"name", "extends"})
    if (json.has(key))
      (json / key).text();
}

} // namespace

std::size_t
LabelRules::find(const std::string& label) const
{
  const auto found = std::find_if(labels.begin(), labels.end(), [&](const auto& rule) {
    return rule.name == label;
  });
  return static_cast<std::size_t>(found - labels.begin());
}

unsigned int
labelNumber(const LabelRules& rules, const std::string& label)
{
  constexpr auto kLast = static_cast<unsigned int>(PlaneLabel::kDoor);
  const auto bookNumber = [](const std::string& name) {
    const auto known = findNamed(kPlaneLabels, name);
    return known ? static_cast<unsigned int>(*known) : kLast + 1;
  };
  unsigned int number = bookNumber(label);
  if (number <= kLast)
    return number;
  for (const auto& rule : rules.labels) {
    if (rule.name == label)
      return number;
    if (bookNumber(rule.name) > kLast)
      ++number;
  }
  throw BadArgument("label = " + label + ", but must be one of the rules '" +
                    rules.name + "'");
}

LabelRules
readLabelRules(const std::filesystem::path& path)
{
  const std::string content = text::readFile(path);
  if (content.empty())
    text::fail(path, "is empty");
  return parseLabelRules(content, path.string());
}

LabelRules
parseLabelRules(const std::string& text, const std::string& name)
{
  const JsonValue json = parseJson(text, name);
  checkHeader(json);
  LabelRules rules;
  if (json.has("extends")) {
    (json / "extends").require((json / "extends").text() == "book", "\"book\"");
    rules = bookRules();
  }
  rules.name = json.has("name") ? (json / "name").text() : name;
  addRules(json, rules);
  checkRules(rules, name);
  return rules;
}

} // namespace pcl6d
