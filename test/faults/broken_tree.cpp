// SPDX-License-Identifier: BSD-3-Clause
// Breakages of trees: JSON key by key, and nesting of JSON, XML and YAML.
#include "breakage.h"

#include <nlohmann/json.hpp>

#include <cctype>
#include <utility>

namespace pcl6d::faults {

namespace {
using Json = nlohmann::ordered_json;

constexpr const char* kMark =
    "PCL6D-FAULTS-MARK"; // stands for text that no value makes

/** \return pointers to values; of arrays of many alike some, drawn by chance */
void
addPointers(const Json& value,
            const Json::json_pointer& at,
            Random& random,
            std::vector<Json::json_pointer>& pointers)
{
  if (!value.is_structured())
    return;
  const bool many = value.is_array() && value.size() > 4;
  std::size_t index = 0;
  const std::size_t chosen = pick(random, value.size());
  for (const auto& item : value.items()) {
    if (many && index++ != chosen)
      continue;
    const auto child = value.is_array() ? at / std::stoul(item.key()) : at / item.key();
    pointers.push_back(child);
    addPointers(item.value(), child, random, pointers);
  }
}

/** Values of all types, of which most are wrong at any place. */
std::vector<std::pair<const char*, std::string>>
otherValues()
{
  const std::string deep = std::string(200, '[') + std::string(200, ']');
  return {{"json-null", "null"},
          {"json-bool", "true"},
          {"json-text", "\"no\""},
          {"json-empty-text", "\"\""},
          {"json-array", "[]"},
          {"json-array", "[1,2,3]"},
          {"json-object", "{}"},
          {"json-object", R"({"a":1})"},
          {"json-number", "7"},
          {"json-number", "-1"},
          {"json-number", "0.5"},
          {"json-huge", "1e308"},
          {"json-huge", "1e20"},
          {"json-huge", "4294967296"},
          {"json-huge", "18446744073709551615"},
          {"json-huge", "-9223372036854775808"},
          {"json-huge", "1000000000"},
          {"json-tiny", "1e-320"},
          {"json-no-number", "NaN"},
          {"json-no-number", "1e999"},
          {"json-control", R"("a\u0000b\u001b[31m\n")"},
          {"json-control", R"("..\/..\/..\/etc\/passwd")"},
          {"json-surrogate", R"("\ud800")"},
          {"json-nested", deep},
          {"json-long", '"' + std::string(100'000, 'x') + '"'}};
}

std::string
withMarkReplaced(const Json& tree, const std::string& with)
{
  const std::string text = tree.dump(1);
  const std::string mark = '"' + std::string(kMark) + '"';
  return replaced(text, text.find(mark), mark.size(), with);
}

Breakages
brokenKeys(const Json& tree, Random& random)
{
  Breakages result;
  std::vector<Json::json_pointer> pointers;
  addPointers(tree, Json::json_pointer(), random, pointers);
  for (const auto& [kind, value] : otherValues())
    for (int i = 0; i < 4 && !pointers.empty(); ++i) {
      Json marked = tree;
      marked[pointers[pick(random, pointers.size())]] = kMark;
      const bool no_json = value == "NaN";
      result.push_back(withBytes(kind, no_json, withMarkReplaced(marked, value)));
    }
  for (int i = 0; i < 30 && !pointers.empty(); ++i) {
    const auto& pointer = pointers[pick(random, pointers.size())];
    Json lacking = tree, marked = tree;
    Json& parent = lacking[pointer.parent_pointer()];
    if (parent.is_object())
      parent.erase(pointer.back());
    else
      parent.erase(std::stoul(pointer.back()));
    result.push_back(withBytes("json-missing", false, lacking.dump(1)));
    if (!parent.is_object())
      continue;
    const std::string value = tree[pointer].dump();
    marked[pointer] = kMark;
    const std::string key = Json(pointer.back()).dump();
    result.push_back(withBytes(
        "json-twice", false, withMarkReplaced(marked, "null," + key + ":" + value)));
  }
  return result;
}

std::string
times(std::size_t count, const std::string& text)
{
  std::string result;
  result.reserve(count * text.size());
  for (std::size_t i = 0; i < count; ++i)
    result += text;
  return result;
}

/** Nested so deep that a reader that calls itself runs out of stack. */
Breakages
nested(const std::vector<std::pair<std::string, std::string>>& brackets,
       const std::string& before,
       const std::string& after)
{
  Breakages result;
  for (const std::size_t depth : {20'000u, 1'000'000u})
    for (const auto& [open, close] : brackets)
      for (const bool closed : {true, false})
        result.push_back(withMadeBytes(depth > 100'000 ? "very-deep" : "deep",
                                       true,
                                       [=, open = open, close = close] {
                                         return before + times(depth, open) +
                                                (closed ? times(depth, close) + after
                                                        : "");
                                       }));
  return result;
}

/** The same in the place of a value that is there. */
Breakages
nestedValues(const Json& tree, Random& random)
{
  Breakages result;
  std::vector<Json::json_pointer> pointers;
  addPointers(tree, Json::json_pointer(), random, pointers);
  for (int i = 0; i < 8 && !pointers.empty(); ++i) {
    Json marked = tree;
    marked[pointers[pick(random, pointers.size())]] = kMark;
    const std::size_t depth = i % 2 ? 20'000 : 1'000'000;
    result.push_back(withMadeBytes("deep-value", true, [marked, depth, i] {
      return i % 4 < 2
                 ? withMarkReplaced(marked, times(depth, "[") + times(depth, "]"))
                 : withMarkReplaced(marked,
                                    times(depth, R"({"a":)") + "1" + times(depth, "}"));
    }));
  }
  return result;
}

/** \return the text up to the end of its first tag that is no declaration, or "" */
std::string
rootOf(const std::string& xml)
{
  for (std::size_t at = xml.find('<'); at != std::string::npos;
       at = xml.find('<', at + 1))
    if (std::isalpha(static_cast<unsigned char>(xml[at + 1])))
      return xml.substr(0, xml.find('>', at) + 1);
  return "";
}
} // namespace

Breakages
brokenTree(const Victim& victim, Random& random)
{
  if (victim.format == Format::kXml) {
    const std::string root = rootOf(victim.bytes);
    return nested({{"<g>", "</g>"}, {"<_>", "</_>"}}, root, "");
  }
  if (victim.format == Format::kYaml)
    return nested({{"[", "]"}, {"{a: ", "}"}, {"- ", ""}}, "%YAML:1.0\n---\na: ", "\n");
  if (victim.format != Format::kJson)
    return {};
  const Json tree = Json::parse(victim.bytes);
  Breakages result = brokenKeys(tree, random);
  for (const auto& family :
       {nested({{"[", "]"}, {R"({"a":)", "}"}, {R"([{"a":)", "}]"}}, "", ""),
        nestedValues(tree, random)})
    result.insert(result.end(), family.begin(), family.end());
  return result;
}

} // namespace pcl6d::faults
