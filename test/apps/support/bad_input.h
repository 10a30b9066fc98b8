// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/run_program.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace pcl6d::test {

inline constexpr const char* kName = "pcl_slam6d";

/** A scan with a pose, from which matching starts. */
inline std::string
pcd(const std::string& fields, int count, const std::string& body)
{
  std::string sizes, types, counts;
  for (std::size_t i = 0; i < (fields.size() + 1) / 2; ++i) {
    sizes += " 4";
    types += " F";
    counts += " 1";
  }
  const std::string n = std::to_string(count);
  return "VERSION 0.7\nFIELDS " + fields + "\nSIZE" + sizes + "\nTYPE" + types +
         "\nCOUNT" + counts + "\nWIDTH " + n +
         "\nHEIGHT 1\nVIEWPOINT 1 0 0 1 0 0 0\nPOINTS " + n + "\nDATA ascii\n" + body;
}

inline std::string
grid()
{
  std::string body;
  for (int i = 0; i < 64; ++i)
    body += std::to_string(i % 4) + " " + std::to_string(i / 4 % 4) + " " +
            std::to_string(i / 16) + "\n";
  return pcd("x y z", 64, body);
}

inline constexpr const char* kIdentityRow = "1 0 0 0 0 1 0 0 0 0 1 0\n";

/** Three good scans in a folder "in", which each test then spoils. */
class BadInput : public testing::Test {
protected:
  void
  SetUp() override
  {
    std::filesystem::create_directory(in);
    for (const char* name : {"scan000.pcd", "scan001.pcd", "scan002.pcd"})
      writeText(in / name, grid());
  }

  /** Runs on "in" and expects an error with the words; nothing else may change. */
  void
  expectRefused(const std::vector<std::string>& words)
  {
    const auto before = contentOf(in);
    const auto outcome = runProgram(kName, {in.string(), "-o", out.string()});
    pcl6d::test::expectError(outcome, kName, 1, words);
    EXPECT_FALSE(std::filesystem::exists(out));
    EXPECT_EQ(contentOf(in), before);
  }

  void
  expectUsageError(std::vector<std::string> arguments,
                   const std::vector<std::string>& words)
  {
    const auto outcome = runProgram(kName, arguments);
    pcl6d::test::expectError(outcome, kName, 2, words);
    EXPECT_FALSE(std::filesystem::exists(out));
  }

  TempFolder folder;
  const std::filesystem::path in = folder / "in";
  const std::filesystem::path out = folder / "out";
};

} // namespace pcl6d::test
