// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "evaluate/suite_file.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/json_object.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/** The names met in the objects that are open; the parser itself keeps the last of two. */
class NameCheck {
public:
  explicit NameCheck(const fs::path& file) : file_(file) {}

  bool
  operator()(int, Json::parse_event_t event, Json& value)
  {
    using Event = Json::parse_event_t;
    if (event == Event::object_start) {
      open_.emplace_back();
    }
    else if (event == Event::object_end) {
      open_.pop_back();
    }
    else if (event == Event::key) {
      const auto name = value.get<std::string>();
      if (!open_.back().names.insert(name).second)
        refuseSuite(file_, place(), "'" + name + "' is there twice");
      open_.back().last = name;
    }
    return true;
  }

private:
  struct Object {
    std::set<std::string> names;
    std::string last;
  };

  std::string
  place() const
  {
    std::string text;
    for (auto object = open_.begin(); object + 1 != open_.end(); ++object)
      text += '/' + object->last;
    return text.empty() ? "/" : text;
  }

  const fs::path& file_;
  std::vector<Object> open_;
};

/** \throws IoFailed the object has other members than these */
void
allow(const JsonValue& node, const std::set<std::string>& names)
{
  std::string known;
  for (const auto& name : names)
    known += (known.empty() ? "" : ", ") + name;
  for (const auto& key : node.keys())
    if (names.count(key) == 0)
      node.fail("'" + key + "' is not known; there are " + known);
}

double
number(const JsonValue& node, double least, const std::string& rule)
{
  node.require(node.isNumber() && node.number() >= least, rule);
  return node.number();
}

/** An object of options, without those in `besides`. */
SuiteOptions
optionsOf(const JsonValue& node, const std::set<std::string>& besides = {})
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

/** An object of options, which may be missing. */
SuiteOptions
optionsIn(const JsonValue& node, const std::string& name)
{
  return node.has(name) ? optionsOf(node / name) : SuiteOptions(SuiteOptions::object());
}

/** Calls for every member of the object, whose names become names of folders. */
template <typename Take>
void
forEachNamed(const JsonValue& node, const Take& take)
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
    node.fail("is empty, but at least one is needed");
}

SuiteData
dataFrom(const std::string& name, const JsonValue& node)
{
  allow(node, {"simulate", "folder", "reference", "options"});
  if (node.has("simulate") == node.has("folder"))
    node.fail("needs either 'simulate' or 'folder'");
  SuiteData data;
  data.name = name;
  if (node.has("simulate")) {
    const JsonValue simulate = node / "simulate";
    data.scene = (simulate / "scene").text();
    data.simulation = optionsOf(simulate, {"scene"});
    if (node.has("reference"))
      (node / "reference").fail("simulated scans have their own");
  }
  else {
    data.folder = (node / "folder").text();
  }
  if (node.has("reference"))
    data.reference = (node / "reference").text();
  data.options = optionsIn(node, "options");
  return data;
}

Json
parseFile(const fs::path& file)
{
  std::ifstream stream(file);
  if (!stream || fs::is_directory(file))
    throw UsageError(file.string() + ": cannot read the suite");
  try {
    return Json::parse(stream, NameCheck(file));
  } catch (const Json::parse_error& e) {
    const std::string text =
        e.what(); // "[json...] parse error at line 1, column 2: ..."
    const auto place = text.find("line ");
    throw UsageError(file.string() + ": no JSON: " +
                     (place == std::string::npos ? text : text.substr(place)));
  }
}

void
readValues(const JsonValue& root, Suite& suite)
{
  suite.title = root.has("title") ? (root / "title").text() : suite.name;
  if (root.has("description"))
    suite.description = (root / "description").text();
  suite.defaults = optionsIn(root, "defaults");
  if (root.has("time_limit"))
    suite.time_limit = number(root / "time_limit", 1e-3, "seconds > 0");
  if (root.has("repetitions")) {
    const JsonValue node = root / "repetitions";
    const double count = number(node, 1, "a whole number from 1 to 100");
    if (count > 100 || count != std::floor(count))
      node.fail("expected a whole number from 1 to 100");
    suite.repetitions = static_cast<int>(count);
  }
  if (root.has("keep_scans"))
    suite.keep_scans = (root / "keep_scans").boolean();
}

Suite
suiteFrom(const JsonValue& root, const fs::path& file)
{
  allow(root,
        {"schema_version",
         "title",
         "description",
         "time_limit",
         "repetitions",
         "keep_scans",
         "defaults",
         "data",
         "methods"});
  const JsonValue version = root / "schema_version";
  version.require(version.isNumber() && version.number() == 1, "1");
  Suite suite;
  suite.file = fs::absolute(file);
  suite.name = file.stem().string();
  readValues(root, suite);
  forEachNamed(root / "data", [&](const std::string& name, const JsonValue& node) {
    suite.data.push_back(dataFrom(name, node));
  });
  forEachNamed(root / "methods", [&](const std::string& name, const JsonValue& node) {
    if (name == "odometry")
      node.fail("the name stands for the initial poses, which are always compared");
    if ((root / "data").has(name))
      node.fail("a data set has the same name");
    suite.methods.push_back({name, optionsOf(node)});
  });
  return suite;
}
} // namespace

void
refuseSuite(const fs::path& file, const std::string& place, const std::string& what)
{
  throw UsageError(file.string() + ": " + place + ": " + what);
}

Suite
readSuite(const fs::path& file)
try {
  return suiteFrom(JsonValue(file.string(), parseFile(file)), file);
} catch (const IoFailed& error) { // a suite is a kind of command line
  throw UsageError(error.what());
}

SuiteOptions
overlaid(SuiteOptions options, const SuiteOptions& over)
{
  for (const auto& item : over.items())
    options[item.key()] = item.value();
  return options;
}

std::vector<std::string>
wordsOf(const SuiteOptions& options)
{
  std::vector<std::string> words;
  for (const auto& [name, value] : options.items()) {
    if (value.is_null() || value == false)
      continue;
    std::string word = "--" + name;
    if (value.is_string())
      word += '=' + value.get<std::string>();
    else if (value != true)
      word += '=' + value.dump();
    words.push_back(word);
  }
  return words;
}

} // namespace pcl6d::app
