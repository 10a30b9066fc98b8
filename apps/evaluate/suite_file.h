// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief Options of a program under their names without dashes: a number, a string, or
 * true for an option without a value. Later ones replace earlier ones; false and null take
 * an option back. */
using SuiteOptions = nlohmann::ordered_json;

/** \brief Scans that all methods get. */
struct SuiteData {
  std::string name;
  std::string scene;       ///< to simulate; empty: the scans are in a folder
  SuiteOptions simulation; ///< options of pcl_slam6d_simulate
  std::string folder;      ///< with scans, if they are not simulated
  std::string reference;   ///< trajectory file; empty: no errors are measured
  SuiteOptions options;    ///< of pcl_slam6d for these data
};

/** \brief A set of options of pcl_slam6d. */
struct SuiteMethod {
  std::string name;
  SuiteOptions options;
};

/** \brief What a suite file says. */
struct Suite {
  std::filesystem::path file; ///< absolute
  std::string name;           ///< of the file, without its extension
  std::string title;
  std::string description;
  SuiteOptions defaults;
  double time_limit = 3600; ///< [s] of one run
  int repetitions = 1;
  bool keep_scans = false; ///< keep scans/ and map.pcd of the runs
  std::vector<SuiteData> data;
  std::vector<SuiteMethod> methods;
};

/** \brief Reads a suite; its fields: share/doc/benchmark.md. What options mean is not
 * checked here.
 * \throws UsageError naming file, place (a JSON pointer), value and rule: unreadable, no
 * JSON, a name twice, an unknown field, a value of another kind, nothing to run */
Suite
readSuite(const std::filesystem::path& file);

/** \brief An error of a suite: file, place and what is wrong. */
[[noreturn]] void
refuseSuite(const std::filesystem::path& file,
            const std::string& place,
            const std::string& what);

/** \return one object with the options of both, those of `over` where both have one */
SuiteOptions
overlaid(SuiteOptions options, const SuiteOptions& over);

/** \return the options as words of a command line: `--name=value` or `--name` */
std::vector<std::string>
wordsOf(const SuiteOptions& options);

} // namespace pcl6d::app
