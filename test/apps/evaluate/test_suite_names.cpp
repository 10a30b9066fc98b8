// SPDX-License-Identifier: BSD-3-Clause
// What the name of a method in share/suites promises, its options set: a table tells no method
// that did not run.
#include "support/folders.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>

namespace {
namespace fs = std::filesystem;
using nlohmann::json;

struct Promise {
  const char*
      words; ///< a regular expression; what it captures is the value, if it does
  const char* option; ///< or several, one of which has the value
  const char* value;  ///< empty: as captured
};

const Promise kPromises[] = {
    {"\\bby points\\b", "metric", "point"},
    {"\\bby planes\\b", "metric", "gicp"},
    {"\\bpairwise\\b", "metascan", "1"},
    {"\\bmetascan\\b", "metascan", "all"},
    {"\\b(elch|uniform|path)\\b", "loop-closing", ""},
    {"\\bno loop closing\\b", "loop-closing", "none"},
    {"\\bmatching only\\b", "relaxation", "none"},
    {"\\bno relaxation\\b", "relaxation", "none"},
    {"(?:^|[ "
     ",])(helix|euler|quaternion-published|quaternion(?!-)|small-angle|simultaneous)"
     "\\b",
     "relaxation minimiser plane-minimiser",
     ""},
    {"\\bonline\\b", "close-loops", "online"},
    {"\\b(unit|pairs|covariance) weights\\b", "link-weights", ""},
    {"\\b(distance|overlap), ", "links", ""},
    {"\\b(\\d+) rounds?\\b", "relaxation-rounds", ""}};

std::string
textOf(const json& value)
{
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/** \return what a method's name promises and its options do not keep; empty: nothing */
std::string
brokenPromise(const std::string& name,
              const std::map<std::string, std::string>& options)
{
  for (const Promise& promise : kPromises) {
    std::smatch match;
    if (!std::regex_search(name, match, std::regex(promise.words)))
      continue;
    const std::string value = *promise.value ? promise.value : match[1].str();
    std::istringstream names(promise.option);
    bool is_kept = false;
    for (std::string option; names >> option;)
      is_kept = is_kept || (options.count(option) > 0 && options.at(option) == value);
    if (!is_kept)
      return name + ": --" + promise.option + " is not " + value;
  }
  return "";
}

std::map<std::string, std::string>
optionsOf(const json& suite, const json& method)
{
  std::map<std::string, std::string> options;
  for (const json& part : {suite.value("defaults", json::object()), method})
    for (const auto& [name, value] : part.items())
      options[name] = textOf(value);
  return options;
}
} // namespace

TEST(SuiteNames, PromiseWhatTheirOptionsSet)
{
  std::size_t methods = 0;
  for (const auto& file :
       fs::directory_iterator(fs::path(PCL6D_SOURCE_DIR) / "share/suites")) {
    const json suite = json::parse(std::ifstream(file.path()));
    for (const auto& [name, method] : suite.at("methods").items()) {
      EXPECT_EQ(brokenPromise(name, optionsOf(suite, method)), "") << file.path();
      ++methods;
    }
  }
  EXPECT_GT(methods, 30u);
}

TEST(SuiteNames, ABrokenPromiseIsFound)
{
  EXPECT_NE(brokenPromise("relaxation by points", {{"metric", "gicp"}}), "");
  EXPECT_NE(brokenPromise("relaxation by points", {}), "");
  EXPECT_NE(brokenPromise("elch, quaternion-published",
                          {{"loop-closing", "elch"}, {"relaxation", "quaternion"}}),
            "");
  EXPECT_NE(brokenPromise("distance, 10 rounds",
                          {{"links", "distance"}, {"relaxation-rounds", "50"}}),
            "");
  EXPECT_EQ(brokenPromise("distance, 10 rounds",
                          {{"links", "distance"}, {"relaxation-rounds", "10"}}),
            "");
}
