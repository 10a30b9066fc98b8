// SPDX-License-Identifier: BSD-3-Clause
#include "rule_reader.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>

namespace pcl6d {
using namespace scene_interpretation;

namespace {
using Json = nlohmann::ordered_json;

Json
parseJson(const std::string& text, const std::string& name)
{
  try {
    return Json::parse(text, nullptr, true, true); // comments are allowed
  } catch (const Json::parse_error& e) {
    const auto end =
        text.begin() + static_cast<std::ptrdiff_t>(std::min(e.byte, text.size()));
    const auto line = 1 + std::count(text.begin(), end, '\n');
    throw IoFailed(name + ": line " + std::to_string(line) +
                   ": not the syntax of JSON");
  } catch (const Json::exception& e) {
    throw IoFailed(name + ": " + e.what());
  }
}

void
checkHeader(const Json& json, const RulePlace& place)
{
  constexpr std::array<const char*, 6> kKeys = {
      "schema_version", "name", "extends", "labels", "constraints", "needs"};
  if (!json.is_object())
    place.fail("no object {...} of rules");
  for (const auto& entry : json.items())
    if (std::find(kKeys.begin(), kKeys.end(), entry.key()) == kKeys.end())
      place.fail("unknown key '" + entry.key() + "'");
  if (json.value("schema_version", Json(1)) != 1)
    (place / "schema_version").fail(json["schema_version"].dump() + ", but must be 1");
  for (const char* key : {"name", "extends"})
    if (json.contains(key) && !json[key].is_string())
      (place / key).fail(json[key].dump() + " is not a text \"...\"");
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
    for (unsigned int i = 0; i <= kLast; ++i)
      if (name == toString(static_cast<PlaneLabel>(i)))
        return i;
    return kLast + 1;
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
  std::ifstream stream(path, std::ios::binary);
  if (!stream || stream.peek() == std::char_traits<char>::eof())
    throw IoFailed(path.string() + ": cannot be read or is empty");
  return parseLabelRules({std::istreambuf_iterator<char>(stream), {}}, path.string());
}

LabelRules
parseLabelRules(const std::string& text, const std::string& name)
{
  const Json json = parseJson(text, name);
  const RulePlace place{name, ""};
  checkHeader(json, place);
  LabelRules rules;
  if (json.contains("extends")) {
    if (json["extends"] != "book")
      (place / "extends").fail(json["extends"].dump() + ", but must be \"book\"");
    rules = bookRules();
  }
  rules.name = json.value("name", name);
  addRules(json, place, rules);
  checkRules(rules, name);
  return rules;
}

} // namespace pcl6d
