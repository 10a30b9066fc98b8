// SPDX-License-Identifier: BSD-3-Clause
// The rule "same binary, same input, same bits on any x86-64 CPU" (portable_math.h).
#include "support/folders.h"
#include "support/run_program.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <sstream>

namespace {
namespace fs = std::filesystem;
using pcl6d::test::TempFolder;

// What a command of the shell prints, and a last line with its exit code, with the code
// of the C library that a CPU with or without vector and FMA units would get. glibc
// reads the variable at the start of a program.
std::string
outputOf(const std::string& command, bool is_plain_cpu = false)
{
  const TempFolder folder;
  const std::string out = folder / "out";
  const std::string tunables =
      is_plain_cpu ? "export GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA; " : "";
  const std::string line =
      "(" + tunables + command + "; echo exit $?) > " + out + " 2> /dev/null";
  EXPECT_EQ(std::system(line.c_str()), 0) << line;
  return pcl6d::test::readText(out);
}

// Every file but the summary, which holds times.
std::map<std::string, std::string>
resultIn(const fs::path& folder)
{
  auto content = pcl6d::test::contentOf(folder);
  for (auto it = content.begin(); it != content.end();)
    it = fs::path(it->first).filename() == "summary.json" ? content.erase(it) : ++it;
  return content;
}
} // namespace

TEST(SameBits, ComeFromTheCLibrarysOtherCode)
{
  const std::string sines =
      "awk 'BEGIN { for (i = 1; i < 9999; ++i) printf \"%.17g \", sin(i) }'";
  if (outputOf(sines) == outputOf(sines, true))
    GTEST_SKIP() << "std::sin has one form here: an old CPU or another C library";
  const TempFolder folder;
  for (const bool is_plain_cpu : {false, true}) {
    const std::string out = folder / (is_plain_cpu ? "plain" : "fma");
    fs::create_directory(out);
    const std::string simulate =
        PCL6D_BIN_DIR "/pcl_slam6d_simulate corridor --scans 3 --quiet -o ";
    EXPECT_EQ(outputOf(simulate + out + "/scans", is_plain_cpu), "exit 0\n");
    // Three scans are too far apart for all to be accepted: exit code 3 is fine.
    const std::string slam = PCL6D_BIN_DIR "/pcl_slam6d --quiet ";
    const std::string printed =
        outputOf(slam + out + "/scans -o " + out + "/map", is_plain_cpu);
    EXPECT_TRUE(printed == "exit 0\n" || printed == "exit 3\n") << printed;
  }
  const auto expected = resultIn(folder / "fma");
  const auto plain = resultIn(folder / "plain");
  EXPECT_EQ(expected.count("map/trajectory.kitti"), 1u);
  ASSERT_EQ(expected.size(), plain.size());
  for (const auto& [name, bytes] : expected) // not EXPECT_EQ, which would print them
    EXPECT_TRUE(plain.count(name) && plain.at(name) == bytes) << name;
}

TEST(SameBits, NoModuleOfTheComputePathCallsTheCLibrarysFunctions)
{
  if (std::system("nm --version > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "nm (package binutils) not found";
  const std::set<std::string> of_other_bits = {
      "sin",  "cos",   "tan",   "sincos", "asin",  "acos",  "atan",  "atan2", "exp",
      "exp2", "exp10", "expm1", "log",    "log2",  "log10", "log1p", "pow",   "sinh",
      "cosh", "tanh",  "asinh", "acosh",  "atanh", "cbrt",  "hypot", "fma"};
  for (const std::string module : {"benchmarking",
                                   "common",
                                   "filters",
                                   "global_registration",
                                   "graph_relaxation",
                                   "io",
                                   "moving_objects",
                                   "plane_segmentation",
                                   "registration",
                                   "scene_interpretation",
                                   "scanner",
                                   "search",
                                   "slam6d",
                                   "verification",
                                   "visibility"}) {
    const std::string library = PCL6D_BUILD_DIR "/lib/libpcl6d_" + module + ".so";
    const std::string names = outputOf("nm -D --undefined-only -f posix " + library);
    ASSERT_NE(names.find("\nexit 0\n"), std::string::npos) << library;
    std::istringstream lines(names);
    for (std::string line; std::getline(lines, line);) {
      std::string name = line.substr(0, line.find_first_of("@ "));
      if (!name.empty() && name.back() == 'f') // float
        name.pop_back();
      EXPECT_EQ(of_other_bits.count(name), 0u) << module << " calls " << line;
    }
  }
}
