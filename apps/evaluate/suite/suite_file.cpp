// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "evaluate/suite/suite_json.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/nesting.h>
#include <pcl6d/io/text.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/** Names in the open objects; of duplicate names the parser silently keeps the last. */
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
        refuseSuite(file_, place(), text::quoted(name) + " is there twice");
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

/** Seeds of one entry; empty without a list. */
std::vector<int>
seedsFrom(const JsonValue& node)
{
  if (!node.has("seeds"))
    return {};
  const JsonValue seeds = node / "seeds";
  if (!node.has("simulate"))
    seeds.fail("only simulated scans have seeds");
  if ((node / "simulate").has("seed"))
    seeds.fail("'simulate' has a seed already");
  if (!seeds.isPair())
    seeds.fail("expected the first and the last seed");
  const auto ends = seeds.elements();
  const int first = ends[0].integer(), last = ends[1].integer();
  seeds.require(first >= 0 && last >= first && last - first < 1000,
                "0 <= first <= last, at most 1000 of them");
  std::vector<int> all;
  for (int seed = first; seed <= last; ++seed)
    all.push_back(seed);
  return all;
}

SuiteData
dataFrom(const std::string& name, const JsonValue& node)
{
  allowMembers(node, {"simulate", "folder", "reference", "options", "seeds"});
  if (node.has("simulate") == node.has("folder"))
    node.fail("needs either 'simulate' or 'folder'");
  SuiteData data;
  data.name = data.entry = data.base = name;
  if (node.has("simulate")) {
    const JsonValue simulate = node / "simulate";
    data.scene = (simulate / "scene").text();
    data.simulation = optionsFrom(simulate, {"scene"});
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

/** \return the data sets of an entry, one per seed */
std::vector<SuiteData>
seededFrom(const std::string& name, const JsonValue& node)
{
  const SuiteData data = dataFrom(name, node);
  std::vector<SuiteData> all;
  for (const int seed : seedsFrom(node)) {
    SuiteData& one = all.emplace_back(data);
    one.name = one.base = name + " seed " + std::to_string(seed);
    one.simulation["seed"] = seed;
  }
  return all.empty() ? std::vector<SuiteData>{data} : all;
}

/** Adds a data set with every damage.
 * \param[in] next data set of a foreign scan */
void
addDamaged(const SuiteData& data, const SuiteData& next, Suite& suite)
{
  for (const SuiteDamage& damage : suite.damages) {
    SuiteData damaged = data;
    damaged.name = data.base + ", " + damage.name;
    damaged.damage = damage;
    if (damage.foreign)
      damaged.foreign = next.base;
    suite.data.push_back(damaged);
  }
}

/** First seeds come first: every data set then gets a result early. */
void
addData(const std::vector<std::vector<SuiteData>>& entries, Suite& suite)
{
  std::size_t most = 0;
  for (const auto& entry : entries)
    most = std::max(most, entry.size());
  for (std::size_t k = 0; k < most; ++k)
    for (std::size_t e = 0; e < entries.size(); ++e) {
      if (k >= entries[e].size())
        continue;
      const auto& next = entries[(e + 1) % entries.size()];
      if (suite.damages.empty())
        suite.data.push_back(entries[e][k]);
      else
        addDamaged(entries[e][k], next[std::min(k, next.size() - 1)], suite);
    }
}

/** Names built from seeds and damages may collide. */
void
requireDifferentNames(const Suite& suite, const JsonValue& node)
{
  std::set<std::string> names;
  for (const SuiteData& data : suite.data)
    if (!names.insert(data.name).second)
      node.fail("two data sets are called '" + data.name + "'");
}

void
readDamages(const JsonValue& root, Suite& suite)
{
  if (!root.has("damages"))
    return;
  forEachNamed(root / "damages", [&](const std::string& name, const JsonValue& node) {
    if ((root / "data").has(name))
      node.fail("a data set already has this name");
    suite.damages.push_back(damageFrom(name, node));
    if (suite.damages.back().foreign && (root / "data").keys().size() < 2)
      (node / "foreign").fail("no second data set to take a scan from");
  });
}

/** \throws UsageError the file cannot be read, or is nested too deep for a suite */
std::string
contentOfSuite(const fs::path& file)
try {
  std::string content = text::readFile(file);
  checkJsonNesting(content, file.string());
  return content;
} catch (const IoFailed& e) {
  throw UsageError(e.what());
}

Json
parseFile(const fs::path& file)
{
  const std::string content = contentOfSuite(file);
  try {
    return Json::parse(content, NameCheck(file));
  } catch (const Json::parse_error& e) {
    const auto end =
        content.begin() + static_cast<std::ptrdiff_t>(std::min(e.byte, content.size()));
    throw UsageError(file.string() + ": no JSON: line " +
                     std::to_string(1 + std::count(content.begin(), end, '\n')));
  } catch (const Json::out_of_range&) {
    throw UsageError(file.string() + ": a number is too large for a double");
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
    suite.time_limit = numberFrom(root / "time_limit", 1e-3, "seconds > 0");
  if (root.has("repetitions")) {
    const JsonValue node = root / "repetitions";
    const double count = numberFrom(node, 1, "a whole number from 1 to 100");
    if (count > 100 || count != std::floor(count))
      node.fail("expected a whole number from 1 to 100");
    suite.repetitions = static_cast<int>(count);
  }
  if (root.has("keep_scans"))
    suite.keep_scans = (root / "keep_scans").boolean();
  if (root.has("table")) {
    const JsonValue node = root / "table";
    node.require(node.isText() && (node.text() == "errors" || node.text() == "trust"),
                 "\"errors\" or \"trust\"");
    suite.evaluates_trust = node.text() == "trust";
  }
}

Suite
suiteFrom(const JsonValue& root, const fs::path& file)
{
  allowMembers(root,
               {"schema_version",
                "title",
                "description",
                "table",
                "time_limit",
                "repetitions",
                "keep_scans",
                "defaults",
                "data",
                "damages",
                "methods"});
  const JsonValue version = root / "schema_version";
  version.require(version.isNumber() && version.number() == 1, "1");
  Suite suite;
  suite.file = fs::absolute(file);
  suite.name = file.stem().string();
  readValues(root, suite);
  std::vector<std::vector<SuiteData>> entries;
  forEachNamed(root / "data", [&](const std::string& name, const JsonValue& node) {
    entries.push_back(seededFrom(name, node));
  });
  readDamages(root, suite);
  addData(entries, suite);
  requireDifferentNames(suite, root / "data");
  forEachNamed(root / "methods", [&](const std::string& name, const JsonValue& node) {
    if (name == "odometry")
      node.fail("the name is reserved for the initial poses, always compared");
    if ((root / "data").has(name))
      node.fail("a data set already has this name");
    if (root.has("damages") && (root / "damages").has(name))
      node.fail("a damage already has this name");
    suite.methods.push_back({name, optionsFrom(node)});
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
