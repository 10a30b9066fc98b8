// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "apps/evaluate/csv_rows.h"
#include "apps/support/corridor_run.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace pcl6d::test {

/** A suite file in a folder of its own, which each test changes. */
class SuiteTest : public testing::Test {
protected:
  /** Two quick methods on the first four scans of a simulated folder. */
  nlohmann::ordered_json
  smallSuite() const
  {
    nlohmann::ordered_json suite;
    suite["schema_version"] = 1;
    suite["data"]["corridor"] = {{"folder", scans().string()},
                                 {"reference", (scans() / "groundtruth.txt").string()},
                                 {"options", {{"last", 3}}}};
    suite["defaults"] = {{"relaxation", "none"}, {"loop-closing", "none"}};
    suite["methods"]["pairwise"] = {{"metric", "point"}, {"metascan", 1}};
    suite["methods"]["metascan"] = {{"metric", "point"}, {"metascan", "all"}};
    return suite;
  }

  Outcome
  run(const nlohmann::ordered_json& suite, const std::vector<std::string>& more = {})
  {
    return runText(suite.dump(), more);
  }

  Outcome
  runText(const std::string& text, const std::vector<std::string>& more = {})
  {
    writeText(file, text);
    std::vector<std::string> arguments = {"suite", file.string(), "-o", out.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runProgram("pcl_slam6d_evaluate", arguments);
  }

  /** Expects that the suite is refused before anything is written. */
  void
  expectRefused(const std::string& text, const std::vector<std::string>& words)
  {
    expectError(runText(text), "pcl_slam6d_evaluate", 2, words);
    EXPECT_FALSE(std::filesystem::exists(out));
  }

  std::filesystem::path
  recordOf(const std::string& method) const
  {
    return out / "runs" / "corridor" / method / "1" / "run.json";
  }

  /** \return the row of a method in table.csv */
  CsvRow
  rowOf(const std::string& method) const
  {
    for (const CsvRow& row : readCsv(out / "table.csv"))
      if (row.at("method") == method)
        return row;
    ADD_FAILURE() << "no row " << method;
    return {};
  }

  TempFolder folder;
  const std::filesystem::path file = folder / "small.json";
  const std::filesystem::path out = folder / "out";
};

} // namespace pcl6d::test
