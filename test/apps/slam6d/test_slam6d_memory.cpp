// SPDX-License-Identifier: BSD-3-Clause
// Programs within a budget of memory.
#include "apps/support/corridor_run.h"
#include "support/folders.h"

#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {
namespace fs = std::filesystem;
using pcl6d::test::contentOf;
using pcl6d::test::runProgram;
using pcl6d::test::scans;
using pcl6d::test::slam;
using pcl6d::test::TempFolder;

/** \return [MB] that a program that ends well had in memory at most */
double
peakOf(const std::string& program, std::vector<std::string> arguments)
{
  const std::string path = std::string(PCL6D_BIN_DIR "/") + program;
  arguments.insert(arguments.begin(), program);
  std::vector<char*> words;
  for (std::string& word : arguments)
    words.push_back(word.data());
  words.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    ::execv(path.c_str(), words.data());
    ::_exit(127);
  }
  int status = 0;
  rusage usage{};
  ::wait4(child, &status, 0, &usage);
  EXPECT_EQ(status, 0) << program;
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

std::map<std::string, std::string>
withoutTimes(const fs::path& run)
{
  static const std::regex times("\"(seconds|peak_memory_mb)\": [^,\n]*");
  std::map<std::string, std::string> files = contentOf(run);
  files["summary.json"] = std::regex_replace(files["summary.json"], times, "");
  return files;
}

/** A scan of a wavy floor and a wall, as binary PCD with x y z and intensity. */
void
writeLargeScan(const fs::path& file, std::size_t points)
{
  std::ofstream out(file, std::ios::binary);
  out << "VERSION 0.7\nFIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 "
         "1\n"
      << "WIDTH " << points << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << points
      << "\nDATA binary\n";
  std::uint32_t state = 1;
  const auto next = [&state] {
    state = state * 1664525U + 1013904223U;
    return static_cast<float>(state >> 8) / (1 << 24);
  };
  for (std::size_t i = 0; i < points; ++i) {
    const float a = 40 * next() - 20, b = 40 * next() - 20;
    const bool is_wall = i % 3 == 0;
    const float p[4] = {a, is_wall ? 15.F : b, is_wall ? 0.2F * (b + 20) : -1.5F, b};
    out.write(reinterpret_cast<const char*>(p), sizeof p);
  }
}
} // namespace

TEST(MemoryBudget, KeepsTheProcessSmallAndTheBytesTheSame)
{
  const TempFolder folder;
  const std::vector<std::string> options = {
      "--no-picture", "--quiet", "--threads", "2", "--voxel", "0.05"};
  const auto run = [&](const std::string& out, std::vector<std::string> more) {
    more.insert(more.begin(), options.begin(), options.end());
    more.insert(more.begin(), {scans().string(), "-o", (folder / out).string()});
    return peakOf("pcl_slam6d", more);
  };
  const double free = run("free", {}), bounded = run("bounded", {"--memory", "180M"});
  EXPECT_GT(free, 250); // or the test tells nothing
  EXPECT_LT(bounded, 1.1 * 180);
  EXPECT_EQ(withoutTimes(folder / "bounded"), withoutTimes(folder / "free"));
}

TEST(MemoryBudget, HoldsForOneLargeScan)
{
  const TempFolder folder;
  writeLargeScan(folder / "scan000.pcd", 3000000);
  const std::string in = folder.path().string();
  EXPECT_LT(peakOf("pcl_slam6d",
                   {in,
                    "-o",
                    (folder / "out").string(),
                    "--no-picture",
                    "--quiet",
                    "--memory",
                    "240M"}),
            1.1 * 240);
  EXPECT_LT(peakOf("pcl_slam6d_convert",
                   {"scans",
                    (folder / "scan000.pcd").string(),
                    "-o",
                    (folder / "scan.ply").string(),
                    "--quiet",
                    "--memory",
                    "150M"}),
            1.1 * 150);
}

TEST(MemoryBudget, WhatIsTooLittleIsToldWithWhatIsNeeded)
{
  const TempFolder folder;
  const auto small = slam(scans(), folder / "out", {"--memory", "20M"});
  EXPECT_EQ(small.exit_code, 1);
  const std::regex told("pcl_slam6d: error: .*scan000.pcd: [0-9]+ points; two scans of "
                        "this size need --memory [0-9]+M\n");
  EXPECT_TRUE(
      std::regex_match(small.err.substr(small.err.find("pcl_slam6d: error")), told))
      << small.err;
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(MemoryBudget, SizesThatAreNoneAreRefused)
{
  const TempFolder folder;
  for (const char* size : {"0", "-1G", "much", "900T"}) {
    const auto outcome =
        slam(scans(), folder / "out", {"--memory=" + std::string(size)});
    EXPECT_EQ(outcome.exit_code, 2) << size;
    EXPECT_NE(outcome.err.find("--memory"), std::string::npos) << outcome.err;
  }
}
