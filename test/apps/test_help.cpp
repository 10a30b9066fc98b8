// SPDX-License-Identifier: BSD-3-Clause
// What every program says of itself: --help, its man page, and completion in bash.
#include "support/folders.h"
#include "support/run_program.h"

#include <boost/process.hpp>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <sstream>

namespace {
namespace bp = boost::process;
namespace fs = std::filesystem;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::TempFolder;
using Words = std::set<std::string>;

std::vector<std::string>
programs()
{
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(PCL6D_BIN_DIR))
    if (entry.path().filename().string().rfind("pcl_slam6d", 0) == 0)
      names.push_back(entry.path().filename());
  return names;
}

/** \return the help of a program, or of one of its jobs, in so many columns */
std::string
help(const std::string& program, int columns, const std::string& job = "")
{
  const TempFolder folder;
  std::vector<std::string> arguments = {"--help"};
  if (!job.empty())
    arguments.insert(arguments.begin(), job);
  bp::environment environment = boost::this_process::environment();
  environment["COLUMNS"] = std::to_string(columns);
  EXPECT_EQ(bp::system(std::string(PCL6D_BIN_DIR "/") + program,
                       bp::args = arguments,
                       environment,
                       bp::std_out > (folder / "out").string()),
            0);
  return readText(folder / "out");
}

/** \return the first groups of all places that match */
Words
allMatches(const std::string& text, const std::string& pattern)
{
  const std::regex regex(pattern);
  Words words;
  for (std::sregex_iterator i(text.begin(), text.end(), regex), end; i != end; ++i)
    words.insert((*i)[1]);
  return words;
}

/** \return the jobs of a program, and "" if it has only one, or options beside them */
Words
jobsOf(const std::string& program)
{
  const std::string text = help(program, 100);
  if (text.find("--help tells the options") == std::string::npos)
    return {""};
  Words jobs = allMatches(text, "\n  ([a-z][a-z-]*)[ \n]");
  if (text.find("\n  --") != std::string::npos)
    jobs.insert("");
  return jobs;
}

Words
optionsOf(const std::string& help)
{
  return allMatches(help, "\n  (?:-., )?(--[a-z0-9-]+)");
}

std::string
pageOf(const std::string& program, const std::string& job = "")
{
  return PCL6D_BUILD_DIR "/share/man/man1/" + program + (job.empty() ? "" : "-") + job +
         ".1";
}

/** \return what man shows of a page, in long lines; what it warns of goes to err */
Outcome
shownPage(const std::string& page)
{
  const TempFolder folder;
  bp::environment environment = boost::this_process::environment();
  environment["MANWIDTH"] = "300";
  environment["LC_ALL"] = "C.UTF-8";
  Outcome outcome;
  outcome.exit_code = bp::system(bp::search_path("man"),
                                 bp::args = {"--warnings=w", "-l", page},
                                 environment,
                                 bp::std_out > (folder / "out").string(),
                                 bp::std_err > (folder / "err").string());
  outcome.out = readText(folder / "out");
  outcome.err = readText(folder / "err");
  return outcome;
}

/** \return what bash offers when TAB is pressed behind the last of the words */
Words
completed(const std::vector<std::string>& line)
{
  const TempFolder folder;
  const std::string script =
      "PATH=" PCL6D_BIN_DIR ":$PATH\n"
      "source " PCL6D_SOURCE_DIR "/share/completion/pcl_slam6d.bash\n"
      "COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); $(complete "
      "-p \"$1\" | sed -E 's/.*-F ([^ ]+) .*/\\1/') >/dev/null\n"
      "printf '%s\\n' \"${COMPREPLY[@]}\"\n";
  pcl6d::test::writeText(folder / "script", script);
  std::vector<std::string> arguments = {(folder / "script").string()};
  arguments.insert(arguments.end(), line.begin(), line.end());
  EXPECT_EQ(bp::system(bp::search_path("bash"),
                       bp::args = arguments,
                       bp::std_out > (folder / "out").string(),
                       bp::std_err > (folder / "err").string()),
            0);
  EXPECT_EQ(readText(folder / "err"), "");
  std::istringstream lines(readText(folder / "out"));
  Words words;
  for (std::string word; std::getline(lines, word);)
    if (!word.empty())
      words.insert(word);
  return words;
}

bool
isIn(const std::string& word, const Words& words)
{
  return words.count(word) > 0;
}
} // namespace

TEST(Help, FitsTheColumnsAndBreaksListsBehindBars)
{
  for (const auto& program : programs())
    for (const auto& job : jobsOf(program))
      for (const int columns : {80, 100}) {
        const std::string text = help(program, columns, job);
        std::istringstream options(text.substr(text.find("\n\n")));
        for (std::string line; std::getline(options, line);)
          EXPECT_TRUE(line.rfind("  ", 0) != 0 ||
                      line.size() <= static_cast<std::size_t>(columns))
              << line;
      }
  const std::string narrow = help("pcl_slam6d", 60);
  EXPECT_NE(narrow.find("svd|quaternion|orthonormal|\n"), std::string::npos) << narrow;
}

TEST(Help, EndsWithThePageOfMessages)
{
  const std::string end =
      "\n\nErrors and warnings, with cause and remedy: share/doc/messages.md\n";
  for (const auto& program : programs()) {
    Words jobs = jobsOf(program);
    jobs.insert("");
    for (const auto& job : jobs) {
      const std::string text = help(program, 100, job);
      EXPECT_EQ(text.substr(text.size() - std::min(text.size(), end.size())), end)
          << program << ' ' << job;
    }
  }
  EXPECT_TRUE(fs::exists(PCL6D_SOURCE_DIR "/share/doc/messages.md"));
}

TEST(Help, WithoutArgumentsIsFiveLinesWithThreeCommandsOfTheProgram)
{
  for (const auto& program : programs()) {
    const Outcome outcome = pcl6d::test::runProgram(program, {});
    EXPECT_EQ(outcome.exit_code, 2) << program;
    EXPECT_EQ(outcome.out, "") << program;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 5)
        << outcome.err;
    const Words jobs = jobsOf(program);
    std::istringstream lines(outcome.err);
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line.rfind(program + ' ', 0), 0u) << line;
    for (int i = 0; i < 3 && std::getline(lines, line); ++i) {
      EXPECT_EQ(line.rfind("  " + program + ' ', 0), 0u) << line;
      EXPECT_LE(line.size(), 110u) << line;
      const std::string first = line.substr(
          program.size() + 3, line.find(' ', program.size() + 3) - program.size() - 3);
      const std::string job = isIn(first, jobs) ? first : "";
      EXPECT_TRUE(isIn(job, jobs)) << line;
      for (const auto& option : allMatches(line, "(--[a-z0-9-]+)"))
        EXPECT_TRUE(isIn(option, optionsOf(help(program, 10000, job)))) << line;
    }
  }
}

TEST(Help, InAVeryWideWindowHasEachOptionOnOneLineWithTheSameWords)
{
  const auto squeezed = [](const std::string& text) {
    return std::regex_replace(text, std::regex("[ \n]+"), "");
  };
  EXPECT_EQ(squeezed(help("pcl_slam6d", 60)), squeezed(help("pcl_slam6d", 10000)));
  const std::string wide = help("pcl_slam6d", 10000);
  std::istringstream lines(wide.substr(wide.find("\n\n")));
  for (std::string line; std::getline(lines, line);)
    EXPECT_TRUE(std::regex_match(
        line,
        std::regex(
            "|[A-Z][a-z ]+:|  (-., )?--[a-z-]+( [^ ]+)*  +[^ ].*|Errors and .*")))
        << line;
}

TEST(ManPages, HaveEachOptionAndEachJob)
{
  ASSERT_GE(programs().size(), 6u);
  for (const auto& program : programs())
    for (const auto& job : jobsOf(program)) {
      const std::string page =
          std::regex_replace(readText(pageOf(program, job)), std::regex(R"(\\-)"), "-");
      const Words options = optionsOf(help(program, 10000, job));
      EXPECT_GE(options.size(), 3u) << program << ' ' << job;
      EXPECT_EQ(allMatches(page, R"(\n\.TP\n\\fB(?:-., )?(--[a-z0-9-]+)\\fR)"), options)
          << program << ' ' << job;
      EXPECT_TRUE(job.empty() ||
                  readText(pageOf(program)).find("\\fB" + job + "\\fR") !=
                      std::string::npos)
          << program << ' ' << job;
    }
}

TEST(ManPages, AreShownWithoutWarning)
{
  if (bp::search_path("man").empty())
    GTEST_SKIP() << "the program man is not installed";
  for (const auto& program : programs()) {
    Words jobs = jobsOf(program);
    jobs.insert("");
    for (const auto& job : jobs) {
      const Outcome shown = shownPage(pageOf(program, job));
      EXPECT_EQ(shown.exit_code, 0);
      EXPECT_EQ(shown.err, "") << program << ' ' << job;
      for (const char* part : {"NAME", "SYNOPSIS", "DESCRIPTION", "EXIT STATUS"})
        EXPECT_NE(shown.out.find(part), std::string::npos) << program << ' ' << job;
    }
  }
}

TEST(ManPages, SayWhatTheHelpSays)
{
  if (bp::search_path("man").empty())
    GTEST_SKIP() << "the program man is not installed";
  const std::string shown = shownPage(pageOf("pcl_slam6d")).out;
  for (const char* words :
       {"pcl_slam6d - registers the 3D scans of a folder",
        "pcl_slam6d SCAN_DIR|SITE.e57|DRIVE.bag|FILE FILE ... -o OUT_DIR [options]",
        "-o, --output OUT_DIR\n              folder to write; made if missing\n",
        "lines `name = value`; the command line wins",
        ".g2o, or lines 'a b' with the indices",
        "is not reliable",
        "pcl_slam6d_graph(1)"})
    EXPECT_NE(shown.find(words), std::string::npos) << words << "\n" << shown;
}

TEST(Completion, GivesJobsOptionsAndTheWordsOfAnOption)
{
  EXPECT_EQ(completed({"pcl_slam6d_graph", ""}),
            (Words{"convert", "optimize", "info", "--help", "--version"}));
  EXPECT_EQ(completed({"pcl_slam6d", "--relaxation-"}), Words{"--relaxation-rounds"});
  EXPECT_EQ(completed({"pcl_slam6d", "--metric", ""}),
            (Words{"point", "plane", "gicp"}));
  EXPECT_EQ(completed({"pcl_slam6d", "--metric", "p"}), (Words{"point", "plane"}));
  EXPECT_EQ(completed({"pcl_slam6d", "in", "--metric", "=", "pl"}), Words{"plane"});
  EXPECT_EQ(completed({"pcl_slam6d", "in", "--metric", "="}),
            (Words{"point", "plane", "gicp"}));
  EXPECT_EQ(completed({"pcl_slam6d", "--metascan", ""}), Words{"all"});
  EXPECT_EQ(completed({"pcl_slam6d", "--voxel", ""}), Words{"auto"});
  EXPECT_EQ(completed({"pcl_slam6d", "--iterations", ""}), Words{});
  EXPECT_EQ(completed({"pcl_slam6d", "--quiet", "--seed", "1", "--quie"}),
            Words{"--quiet"});
  EXPECT_EQ(completed({"pcl_slam6d_simulate", "cor"}), Words{"corridor"});
  EXPECT_EQ(completed({"pcl_slam6d_simulate", "intr"}), Words{"intrude"});
  EXPECT_EQ(completed({"pcl_slam6d_simulate", "intrude", "--car"}), Words{"--cars"});
  EXPECT_EQ(completed({"pcl_slam6d_convert", "stereo", "--matcher", ""}),
            (Words{"sgbm", "bm"}));
  EXPECT_EQ(completed({"pcl_slam6d_render", "picture", "--background", ""}),
            (Words{"dark", "light"}));
  EXPECT_TRUE(
      isIn("before-after", completed({"pcl_slam6d_render", "picture", "--view", ""})));
  EXPECT_TRUE(isIn("vlp16", completed({"pcl_slam6d_simulate", "--scanner", ""})));
}

TEST(Completion, KnowsEachOptionOfEachProgram)
{
  for (const auto& program : programs())
    for (const auto& job : jobsOf(program)) {
      std::vector<std::string> line = {program};
      if (!job.empty())
        line.push_back(job);
      line.push_back("--");
      EXPECT_EQ(completed(line), optionsOf(help(program, 10000, job)))
          << program << ' ' << job;
    }
}

TEST(Completion, GivesFilesAndFolders)
{
  const TempFolder folder;
  fs::create_directory(folder / "scans of today");
  pcl6d::test::writeText(folder / "some.cfg", "");
  const std::string start = (folder / "s").string();
  const std::string file = folder / "some.cfg", directory = folder / "scans of today";
  EXPECT_EQ(completed({"pcl_slam6d", "-o", start}), Words{directory});
  EXPECT_EQ(completed({"pcl_slam6d", start, "--config", start}),
            (Words{file, directory}));
  EXPECT_EQ(completed({"pcl_slam6d", start}), (Words{file, directory}));
  EXPECT_EQ(completed({"pcl_slam6d_graph", "info", start}), (Words{file, directory}));
  EXPECT_EQ(completed({"pcl_slam6d_graph", "nonsense", start}), Words{});
}
