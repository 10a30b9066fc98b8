// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "evaluate/suite_file.h"

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

/** A value in the file, with its place. */
class Node {
public:
  Node(const fs::path& file, const Json& json, std::string place = "")
  : file_(file), json_(json), place_(std::move(place))
  {}

  [[noreturn]] void
  refuse(const std::string& what) const
  {
    refuseSuite(file_, place_.empty() ? "/" : place_, what);
  }

  const Json&
  object() const
  {
    if (!json_.is_object())
      refuse("expected an object, got " + json_.dump());
    return json_;
  }

  bool
  has(const std::string& name) const
  {
    return object().contains(name);
  }

  Node
  at(const std::string& name) const
  {
    if (!has(name))
      refuse("'" + name + "' is missing");
    return {file_, json_.at(name), place_ + '/' + name};
  }

  void
  allow(const std::set<std::string>& names) const
  {
    std::string known;
    for (const auto& name : names)
      known += (known.empty() ? "" : ", ") + name;
    for (const auto& item : object().items())
      if (names.count(item.key()) == 0)
        refuse("'" + item.key() + "' is not known; there are " + known);
  }

  std::string
  text() const
  {
    if (!json_.is_string())
      refuse("expected a text, got " + json_.dump());
    return json_.get<std::string>();
  }

  double
  number(double least, const std::string& rule) const
  {
    if (!json_.is_number() || !(json_.get<double>() >= least))
      refuse(json_.dump() + ", but must be " + rule);
    return json_.get<double>();
  }

  bool
  truth() const
  {
    if (!json_.is_boolean())
      refuse(json_.dump() + ", but must be true or false");
    return json_.get<bool>();
  }

  /** An object of options, without those in `besides`. */
  SuiteOptions
  options(const std::set<std::string>& besides = {}) const
  {
    SuiteOptions options = SuiteOptions::object();
    for (const auto& [name, value] : object().items()) {
      if (besides.count(name) > 0)
        continue;
      if (value.is_structured())
        at(name).refuse("expected a number, a text, true, false or null");
      options[name] = value;
    }
    return options;
  }

  /** Calls for every member of the object, whose names become names of folders. */
  template <typename Take>
  void
  forEachNamed(const Take& take) const
  {
    for (const auto& item : object().items()) {
      const std::string& name = item.key();
      const bool unsafe = std::any_of(name.begin(), name.end(), [](unsigned char c) {
        return c < ' ' || c == '/' || c == '|' || c == '"';
      });
      if (name.empty() || name.front() == '.' || name.size() > 100 || unsafe)
        refuse("'" + name +
               "' is no name: 1 to 100 characters, none of / | \", no dot in front");
      take(name, at(name));
    }
    if (object().empty())
      refuse("is empty, but at least one is needed");
  }

private:
  const fs::path& file_;
  const Json& json_;
  std::string place_;
};

SuiteData
dataFrom(const std::string& name, const Node& node)
{
  node.allow({"simulate", "folder", "reference", "options"});
  if (node.has("simulate") == node.has("folder"))
    node.refuse("needs either 'simulate' or 'folder'");
  SuiteData data;
  data.name = name;
  if (node.has("simulate")) {
    const Node simulate = node.at("simulate");
    data.scene = simulate.at("scene").text();
    data.simulation = simulate.options({"scene"});
    if (node.has("reference"))
      node.at("reference").refuse("simulated scans have their own");
  }
  else {
    data.folder = node.at("folder").text();
  }
  if (node.has("reference"))
    data.reference = node.at("reference").text();
  data.options = node.has("options") ? node.at("options").options()
                                     : SuiteOptions(SuiteOptions::object());
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
readValues(const Node& root, Suite& suite)
{
  suite.title = root.has("title") ? root.at("title").text() : suite.name;
  if (root.has("description"))
    suite.description = root.at("description").text();
  suite.defaults = root.has("defaults") ? root.at("defaults").options()
                                        : SuiteOptions(SuiteOptions::object());
  if (root.has("time_limit"))
    suite.time_limit = root.at("time_limit").number(1e-3, "seconds > 0");
  if (root.has("repetitions")) {
    const Node node = root.at("repetitions");
    const double count = node.number(1, "a whole number from 1 to 100");
    if (count > 100 || count != std::floor(count))
      node.refuse("expected a whole number from 1 to 100");
    suite.repetitions = static_cast<int>(count);
  }
  if (root.has("keep_scans"))
    suite.keep_scans = root.at("keep_scans").truth();
}
} // namespace

void
refuseSuite(const fs::path& file, const std::string& place, const std::string& what)
{
  throw UsageError(file.string() + ": " + place + ": " + what);
}

Suite
readSuite(const fs::path& file)
{
  const Json json = parseFile(file);
  const Node root(file, json);
  root.allow({"schema_version",
              "title",
              "description",
              "time_limit",
              "repetitions",
              "keep_scans",
              "defaults",
              "data",
              "methods"});
  const Node version = root.at("schema_version");
  if (json["schema_version"] != 1)
    version.refuse(json["schema_version"].dump() + ", but must be 1");
  Suite suite;
  suite.file = fs::absolute(file);
  suite.name = file.stem().string();
  readValues(root, suite);
  root.at("data").forEachNamed([&](const std::string& name, const Node& node) {
    suite.data.push_back(dataFrom(name, node));
  });
  root.at("methods").forEachNamed([&](const std::string& name, const Node& node) {
    if (name == "odometry")
      node.refuse("the name stands for the initial poses, which are always compared");
    if (root.at("data").has(name))
      node.refuse("a data set has the same name");
    suite.methods.push_back({name, node.options()});
  });
  return suite;
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
