// SPDX-License-Identifier: BSD-3-Clause
// The tool that breaks inputs: it must see every fault of programs whose faults are known.
#include "faults/accepted.h"
#include "faults/breakage.h"
#include "faults/extreme_options.h"
#include "faults/runner.h"
#include "faults/text_table.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace {
namespace fs = std::filesystem;
using namespace pcl6d::faults;
using pcl6d::test::readText;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;
using Kinds = std::set<std::string>;

/** Programs that are scripts, run as the tool runs the suite's. */
class Faults : public testing::Test {
protected:
  Faults()
  {
    fs::create_directories(folder / "samples");
    fs::create_directories(folder / "bin");
    writeText(folder / "samples/in.txt", "1 2 3\n");
  }

  /** \return the kinds of what is found when a script reads in.txt and writes out.txt */
  Kinds
  kindsOf(const std::string& script, bool hopeless = false, double seconds = 20)
  {
    writeText(folder / "bin/program", "#!/bin/sh\n" + script + '\n');
    fs::permissions(folder / "bin/program", fs::perms::owner_all);
    Case one;
    one.name = "program/in.txt/cut-1";
    setCall(one, "in.txt", "program in.txt -o out.txt");
    one.hopeless = hopeless;
    RunnerOptions options;
    options.programs = folder / "bin";
    options.samples = folder / "samples";
    options.scratch = folder / "scratch";
    options.limits.seconds = seconds;
    Kinds kinds;
    runCases({one}, options, [&](const Case& ran, const Trace& trace) {
      for (const Finding& finding : evaluate(ran, trace))
        kinds.insert(finding.kind);
    });
    return kinds;
  }

  const TempFolder folder;
};

Victim
victim(Format format, const std::string& bytes)
{
  Victim made;
  made.format = format;
  made.bytes = bytes;
  return made;
}

std::vector<std::string>
contents(const Victim& broken, std::uint64_t seed)
{
  const TempFolder folder;
  std::vector<std::string> all;
  for (const Breakage& breakage : breakagesOf(broken, 60, seed)) {
    const fs::path file = folder / "file";
    fs::remove_all(file);
    writeText(file, broken.bytes);
    breakage.apply(file);
    const bool is_file = fs::is_regular_file(fs::symlink_status(file));
    all.push_back(breakage.kind + ' ' + (is_file ? readText(file) : "no file"));
  }
  return all;
}
} // namespace

TEST_F(Faults, FindNothingInGoodPrograms)
{
  EXPECT_EQ(kindsOf("cp in.txt out.txt"), Kinds());
  EXPECT_EQ(kindsOf("echo 'program: error: in.txt: line 1: no' >&2; exit 1", true),
            Kinds());
  EXPECT_EQ(kindsOf("echo 'warning: half of it' >&2; cp in.txt out.txt; exit 3", true),
            Kinds());
}

TEST_F(Faults, SeeCrashesHangsAndMemory)
{
  EXPECT_EQ(kindsOf("kill -SEGV $$"), Kinds{"crash"});
  EXPECT_EQ(kindsOf("kill -ABRT $$"), Kinds{"crash"});
  EXPECT_EQ(kindsOf("exit 127"), Kinds{"crash"});
  EXPECT_EQ(kindsOf("echo 'x.cpp:1: runtime error: shift' >&2"), Kinds{"crash"});
  EXPECT_EQ(kindsOf("sleep 100", false, 0.3), Kinds{"hang"});
  EXPECT_EQ(kindsOf("head -c 600000000 /dev/zero | tail | head -c 0"), Kinds{"memory"})
      << "tail keeps its only line";
}

TEST_F(Faults, BeginNothingAfterTheirTimeButTheFirst)
{
  writeText(folder / "bin/program", "#!/bin/sh\ncp in.txt out.txt\n");
  fs::permissions(folder / "bin/program", fs::perms::owner_all);
  std::vector<Case> cases(3);
  for (Case& one : cases)
    setCall(one, "in.txt", "program in.txt -o out.txt");
  RunnerOptions options;
  options.programs = folder / "bin";
  options.samples = folder / "samples";
  options.scratch = folder / "scratch";
  std::size_t run = 0;
  const auto count = [&](const Case&, const Trace&) { ++run; };
  runCases(cases, options, count);
  EXPECT_EQ(run, 3u);
  run = 0;
  options.last_start = std::chrono::steady_clock::time_point::min();
  runCases(cases, options, count);
  EXPECT_EQ(run, 1u);
}

TEST_F(Faults, SeeRawTexts)
{
  const std::string end = " >&2; exit 1";
  EXPECT_EQ(kindsOf("echo 'program: error: in.txt: Success: Success'" + end),
            Kinds{"raw text"});
  EXPECT_EQ(kindsOf("echo 'program: error: vector::reserve'" + end), Kinds{"raw text"});
  EXPECT_EQ(kindsOf("echo 'program: error: Invalid argument'" + end),
            Kinds{"raw text"});
  EXPECT_EQ(kindsOf("printf 'program: error: a\\033[31m\\n'" + end), Kinds{"raw text"});
  EXPECT_EQ(kindsOf("printf 'program: error: %3000d\\n' 1" + end), Kinds{"raw text"});
  EXPECT_EQ(kindsOf("echo 'it did not work'" + end), Kinds{"raw text"});
  EXPECT_EQ(kindsOf("exit 2"), Kinds{"raw text"}) << "no word at all";
}

TEST_F(Faults, SeeWhatIsLeftBehind)
{
  const std::string end = "; echo 'program: error: no' >&2; exit 1";
  EXPECT_EQ(kindsOf("touch other"), Kinds{"leftover"});
  EXPECT_EQ(kindsOf("touch $TMPDIR/x"), Kinds{"leftover"});
  EXPECT_EQ(kindsOf("mkdir -p out.txt; touch out.txt/.a-tmp"), Kinds{"leftover"});
  EXPECT_EQ(kindsOf("echo 4 >> in.txt"), Kinds{"leftover"});
  EXPECT_EQ(kindsOf("rm in.txt"), Kinds{"leftover"});
  EXPECT_EQ(kindsOf("echo half > out.txt" + end), Kinds{"leftover"});
  EXPECT_EQ(kindsOf("setsid sleep 100 >/dev/null 2>&1 &"), Kinds{"leftover"});
}

TEST_F(Faults, SeeFalseSuccess)
{
  EXPECT_EQ(kindsOf("cp in.txt out.txt", true), Kinds{"false success"});
}

TEST_F(Faults, AcceptedOnesNeedAKindAndAReason)
{
  const fs::path file = folder / "accepted.txt";
  writeText(file, "# comment\nhang | ^a/(b|c) | after | it was told to\n");
  auto acceptances = readAcceptances(file);
  Case one;
  one.name = "a/c/d";
  EXPECT_TRUE(isAccepted(one, {"hang", "ended after 20 s"}, acceptances));
  EXPECT_FALSE(isAccepted(one, {"crash", "ended after 20 s"}, acceptances));
  one.name = "b/c/d";
  EXPECT_FALSE(isAccepted(one, {"hang", "ended after 20 s"}, acceptances));
  EXPECT_EQ(acceptances.at(0).uses, 1u);
  for (const char* const row :
       {"hangs | a | b | why\n", "hang | a | b\n", "hang | a | b | \n"}) {
    writeText(file, row);
    EXPECT_THROW(readAcceptances(file), std::runtime_error) << row;
  }
}

TEST(Breakages, DependOnTheSeedAlone)
{
  const Victim json =
      victim(Format::kJson, R"({"a": [1, 2.5, {"b": "text"}], "c": null})");
  EXPECT_EQ(contents(json, 1), contents(json, 1));
  EXPECT_NE(contents(json, 1), contents(json, 2));
}

TEST(Breakages, ChangeEveryFileOfEveryFormat)
{
  const std::string pcd = "# .PCD\nFIELDS x\nPOINTS 2\nDATA ascii\n1.5\n2.5\n";
  for (const Victim& one :
       {victim(Format::kRows, "1 2 3\n4 5 6\n"),
        victim(Format::kPcd, pcd),
        victim(Format::kPly, "ply\nelement vertex 1\nend_header\n1\n"),
        victim(Format::kFloats, std::string(64, '\1')),
        victim(Format::kStl, std::string(134, '\1')),
        victim(Format::kPng, std::string(60, '\1')),
        victim(Format::kXml, "<?xml?><a><b>1</b></a>"),
        victim(Format::kYaml, "%YAML:1.0\n---\na: 1\n"),
        victim(Format::kConfig, "a = 1\n")}) {
    std::size_t changed = 0;
    for (const std::string& content : contents(one, 3))
      changed += content.substr(content.find(' ') + 1) != one.bytes;
    EXPECT_GE(changed, 50u); // of 60: a swap of equal bytes changes nothing
  }
}

TEST(ExtremeOptions, AreReadFromTheHelp)
{
  const std::string help = "usage: program IN\n\nOutput:\n"
                           "  -o, --output FILE      file\n"
                           "  --voxel arg (=auto)    [m] edge\n"
                           "  --count N (=3)         how many\n"
                           "  --metric NAME (=gicp)  point|gicp\n"
                           "  --quiet                no progress\n";
  const auto options = optionsOf(help);
  ASSERT_EQ(options.size(), 4u);
  EXPECT_EQ(options[0].name, "--output");
  EXPECT_EQ(options[0].short_name, "-o");
  EXPECT_FALSE(options[0].is_number);
  EXPECT_TRUE(options[1].is_number);
  EXPECT_TRUE(options[2].is_number);
  EXPECT_FALSE(options[3].is_number);
  EXPECT_TRUE(jobsOf(help).empty());
  EXPECT_EQ(jobsOf("usage: p JOB\n\n  build DIR  makes\n  info MAP   tells\n\n"
                   "p JOB --help tells the options.\n"),
            (std::vector<std::string>{"build", "info"}));
  EXPECT_EQ(jobsOf("usage: p IN\nJobs:\n  info MAP   p info --help tells the options\n"
                   "Run:\n  --quiet   no progress\n"),
            (std::vector<std::string>{"info", ""}));
}
