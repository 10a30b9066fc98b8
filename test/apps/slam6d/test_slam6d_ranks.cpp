// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d as several processes that MPI joins.
#include "apps/support/corridor_run.h"
#include "support/folders.h"

#include <boost/process.hpp>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <thread>
#include <unistd.h>

namespace {
namespace bp = boost::process;
namespace fs = std::filesystem;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::scans;
using pcl6d::test::slam;
using pcl6d::test::TempFolder;
using pcl6d::test::withoutTimes;

const std::string kProgram = PCL6D_BIN_DIR "/pcl_slam6d";
/** Options of a run of the scans up to one. */
std::vector<std::string>
upTo(const std::string& last)
{
  return {"--last", last, "--no-picture", "--threads", "1"};
}

const std::vector<std::string> kOptions = upTo("14");

/** Processes of one machine, however few cores it has, also as root in a container. */
bp::environment
environmentOfRanks()
{
  bp::environment all = boost::this_process::environment();
  all["OMPI_ALLOW_RUN_AS_ROOT"] = "1";
  all["OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"] = "1";
  all["OMPI_MCA_rmaps_base_oversubscribe"] = "1";
  all["OMPI_MCA_hwloc_base_binding_policy"] = "none";
  all["OMPI_MCA_btl_vader_single_copy_mechanism"] = "none";
  return all;
}

const std::map<std::string, std::string>&
alone()
{
  static const std::map<std::string, std::string> files =
      pcl6d::test::filesAlone(kOptions);
  return files;
}

class Ranks : public testing::Test {
protected:
  void
  SetUp() override
  {
    if (bp::search_path("mpirun").empty())
      GTEST_SKIP() << "no mpirun: install openmpi-bin";
  }

  /** Words of one or several processes of a run. */
  std::vector<std::string>
  words(int ranks,
        const std::string& program = kProgram,
        const fs::path& in = scans(),
        const std::vector<std::string>& more = {}) const
  {
    std::vector<std::string> all = {
        "-n", std::to_string(ranks), program, in.string(), "-o", out.string()};
    all.insert(all.end(), kOptions.begin(), kOptions.end());
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  /** The same for ranks of two kinds. */
  static std::vector<std::string>
  joined(std::vector<std::string> some, const std::vector<std::string>& others)
  {
    some.emplace_back(":");
    some.insert(some.end(), others.begin(), others.end());
    return some;
  }

  bp::child
  start(const std::vector<std::string>& arguments,
        const std::string& launcher = "mpirun") const
  {
    for (const auto* name : {"stdout", "stderr"}) // boost would write over them
      fs::remove(folder / name);
    return bp::child(bp::search_path(launcher),
                     bp::args = arguments,
                     bp::env = environmentOfRanks(),
                     bp::std_in<bp::null, bp::std_out>(folder / "stdout").string(),
                     bp::std_err > (folder / "stderr").string());
  }

  Outcome
  run(const std::vector<std::string>& arguments,
      const std::string& launcher = "mpirun") const
  {
    bp::child ranks = start(arguments, launcher);
    if (!ranks.wait_for(std::chrono::seconds(300))) {
      ADD_FAILURE() << "hangs";
      ::kill(ranks.id(), SIGTERM); // mpirun ends the processes
      ranks.wait();
    }
    return {
        ranks.exit_code(), readText(folder / "stdout"), readText(folder / "stderr")};
  }

  /** Expects one line of ours on stderr, with some words; mpirun may add its own. */
  static void
  expectOneLine(const Outcome& outcome, const std::vector<std::string>& parts)
  {
    EXPECT_NE(outcome.exit_code, 0);
    static const std::regex ours("pcl_slam6d: error: [^\n]*");
    const std::sregex_iterator first(outcome.err.begin(), outcome.err.end(), ours), end;
    ASSERT_EQ(std::distance(first, end), 1) << outcome.err;
    for (const std::string& part : parts)
      EXPECT_NE(first->str().find(part), std::string::npos) << outcome.err;
  }

  /** Waits until some scans are matched. mpirun may pass on late what is printed. */
  void
  waitForJournal(bp::child& ranks) const
  {
    constexpr std::uintmax_t kSomeScans = 6000; // bytes of their records
    std::error_code missing;
    while (ranks.running() &&
           (!fs::exists(journal) || fs::file_size(journal, missing) < kSomeScans))
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  /** \return the process of a rank, by its environment; -1: there is none */
  static int
  processOf(int rank, const fs::path& out)
  {
    const std::string wanted = "OMPI_COMM_WORLD_RANK=" + std::to_string(rank);
    for (const auto& entry : fs::directory_iterator("/proc")) {
      const std::string pid = entry.path().filename().string();
      if (pid.find_first_not_of("0123456789") != std::string::npos)
        continue;
      const std::string variables = '\0' + readText(entry.path() / "environ");
      const std::string command = readText(entry.path() / "cmdline");
      if (variables.find('\0' + wanted + '\0') != std::string::npos &&
          command.rfind(kProgram, 0) == 0 &&
          command.find(out.string()) != std::string::npos)
        return std::stoi(pid);
    }
    return -1;
  }

  const TempFolder folder;
  const fs::path out = folder / "out", journal = out / ".pcl6d-journal";
};
} // namespace

TEST_F(Ranks, AnyNumberOfThemGivesTheBytesOfOneProcess)
{
  for (const int ranks : {1, 2, 4}) {
    fs::remove_all(out);
    const Outcome outcome = run(words(ranks));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(withoutTimes(out), alone()) << ranks;
    EXPECT_EQ(outcome.err.find("15 scans, shared by") != std::string::npos, ranks > 1)
        << outcome.err;
    const auto verdict = outcome.out.find("registered");
    EXPECT_NE(verdict, std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.out.find("registered", verdict + 1), std::string::npos)
        << "more than one speaks: " << outcome.out;
  }
}

TEST_F(Ranks, OtherMethodsGiveTheSameBytes)
{
  using Words = std::vector<std::string>;
  for (const Words& more : {Words{"--last", "5", "--metric", "point"},
                            Words{"--last", "5", "--links", "distance"},
                            Words{"--last", "1", "--initial-guess", "features"},
                            Words{"--last", "4", "--initial-guess", "global"}}) {
    fs::remove_all(out);
    Words options = {"--no-picture", "--threads", "1"};
    options.insert(options.end(), more.begin(), more.end());
    const fs::path one = folder / ("one" + more.back());
    const int exit_code = slam(scans(), one, options).exit_code;
    options.insert(options.begin(),
                   {"-n", "3", kProgram, scans().string(), "-o", out.string()});
    EXPECT_EQ(run(options).exit_code, exit_code) << more.back();
    EXPECT_EQ(withoutTimes(out), withoutTimes(one)) << more.back();
  }
}

TEST_F(Ranks, ARunGoesOnWithFurtherScans)
{
  ASSERT_EQ(slam(scans(), folder / "one", upTo("5")).exit_code, 0);
  fs::copy(folder / "one", folder / "two", fs::copy_options::recursive);
  const auto further = [&](const fs::path& run_folder) {
    auto all = upTo("9");
    all.insert(all.begin(), {scans().string(), "--continue", run_folder.string()});
    return all;
  };
  EXPECT_EQ(pcl6d::test::runProgram("pcl_slam6d", further(folder / "one")).exit_code,
            0);
  auto arguments = further(folder / "two");
  arguments.insert(arguments.begin(), {"-n", "2", kProgram});
  EXPECT_EQ(run(arguments).exit_code, 0);
  auto one = withoutTimes(folder / "one"), two = withoutTimes(folder / "two");
  const std::regex name("/(one|two)");
  for (auto* files : {&one, &two})
    (*files)["summary.json"] = std::regex_replace((*files)["summary.json"], name, "");
  EXPECT_EQ(one, two);
}

TEST_F(Ranks, OneThatIsKilledEndsTheRunWhichGoesOn)
{
  for (const int rank : {0, 3}) {
    SCOPED_TRACE(rank);
    fs::remove_all(out);
    bp::child ranks = start(words(4));
    waitForJournal(ranks);
    const int process = processOf(rank, out);
    ASSERT_GT(process, 0);
    ::kill(process, SIGKILL);
    ranks.wait();
    expectOneLine({ranks.exit_code(), "", readText(folder / "stderr")},
                  {"the same command goes on"});
    EXPECT_FALSE(fs::exists(out / "summary.json"));
    ASSERT_TRUE(fs::exists(journal));
    const Outcome again = run(words(4, kProgram, scans(), {"--resume"}));
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_NE(again.err.find("going on with an interrupted run"), std::string::npos)
        << again.err;
    EXPECT_EQ(withoutTimes(out), alone());
  }
}

TEST_F(Ranks, WhatRanksHaveDoneOneProcessGoesOnWith)
{
  // All scans: mpirun takes a second to end its processes, in which fewer would be done.
  const std::vector<std::string> options = {"--no-picture", "--threads", "1"};
  std::vector<std::string> words = {
      "-n", "2", kProgram, scans().string(), "-o", out.string()};
  words.insert(words.end(), options.begin(), options.end());
  std::signal(SIGINT,
              SIG_DFL); // a shell's background ignores it, and so do its children
  bp::child ranks = start(words);
  waitForJournal(ranks);
  ::kill(ranks.id(), SIGINT); // mpirun, as by Ctrl-C
  ranks.wait();
  expectOneLine({ranks.exit_code(), "", readText(folder / "stderr")}, {"goes on"});
  const Outcome again = slam(scans(), out, options);
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NE(again.err.find("going on with an interrupted run"), std::string::npos)
      << again.err;
  EXPECT_EQ(withoutTimes(out), pcl6d::test::filesAlone(options));
}

TEST_F(Ranks, OneThatIsEndedLetsTheFirstSpeak)
{
  // mpirun kills all as soon as one has ended: the first would not come to its words.
  bp::child ranks = start(words(2));
  waitForJournal(ranks);
  const int first = processOf(0, out), other = processOf(1, out);
  ASSERT_GT(first, 0);
  ASSERT_GT(other, 0);
  ::kill(first, SIGSTOP); // as one that gets no core
  ::kill(other, SIGTERM);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_EQ(processOf(1, out), other);
  ::kill(ranks.id(), SIGTERM); // mpirun, which lets the first go on
  ranks.wait();
  expectOneLine({ranks.exit_code(), "", readText(folder / "stderr")}, {"goes on"});
}

TEST_F(Ranks, OtherBinariesAreRefused)
{
  const fs::path other = folder / "pcl_slam6d";
  fs::copy_file(kProgram, other); // of another time
  expectOneLine(run(joined(words(1), words(1, other.string()))),
                {"rank 1 on", "another build of the program"});
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(Ranks, OtherViewsOfTheScansAreRefused)
{
  const fs::path other = folder / "scans";
  fs::copy(scans(), other, fs::copy_options::recursive);
  const fs::path file = other / "scan003.pcd";
  std::ofstream(file, std::ios::app) << 'x';
  expectOneLine(run(joined(words(1), words(1, kProgram, other))),
                {"rank 1 on", "scan003.pcd has", "for rank 0"});
  fs::remove(file);
  expectOneLine(run(joined(words(1), words(1, kProgram, other))),
                {"rank 1 on", "39 scans"});
  fs::remove_all(other);
  expectOneLine(run(joined(words(1), words(1, kProgram, other))),
                {"rank 1 on", other.string()});
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(Ranks, OtherOptionsAreRefused)
{
  expectOneLine(
      run(joined(words(1), words(1, kProgram, scans(), {"--min-overlap", "0.2"}))),
      {"rank 1 on", "another value of --min-overlap"});
}

TEST_F(Ranks, AScanThatOneOfThemCannotReadEndsAll)
{
  const fs::path other = folder / "scans";
  fs::copy(scans(), other, fs::copy_options::recursive);
  const fs::path file = other / "scan005.pcd"; // of rank 1
  std::string bytes = readText(file);
  bytes.replace(bytes.find("FIELDS"), 6, "FIALDS");
  std::ofstream(file, std::ios::binary) << bytes;
  // Of the folder itself, and of one that but rank 1 sees so.
  expectOneLine(run(words(2, kProgram, other)), {"scan005.pcd"});
  expectOneLine(run(joined(words(1), words(1, kProgram, other))), {"scan005.pcd"});
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(Ranks, AnErrorOfTheFirstAloneEndsAll)
{
  fs::create_directories(out);
  std::ofstream(out / "notes.txt") << "mine";
  expectOneLine(run(words(2)), {"folder is not empty"});
  expectOneLine(run({"-n", "2", kProgram, scans().string(), "--metric", "none"}),
                {"--metric"});
}

TEST_F(Ranks, AFolderThatCannotBeWrittenInTheEndIsToldOnce)
{
  fs::create_directories(out / "map.pcd"); // a folder in the place of a file
  const Outcome outcome = run(words(2, kProgram, scans(), {"--force"}));
  expectOneLine(outcome, {"map.pcd"});
  fs::remove_all(out / "map.pcd");
  EXPECT_TRUE(fs::exists(journal));
  EXPECT_EQ(run(words(2, kProgram, scans(), {"--force"})).exit_code, 0);
  EXPECT_EQ(withoutTimes(out), alone());
}

TEST_F(Ranks, HelpIsGivenOnce)
{
  const Outcome outcome = run({"-n", "2", kProgram, "--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  const auto usage = outcome.out.find("usage: pcl_slam6d");
  ASSERT_NE(usage, std::string::npos);
  EXPECT_EQ(outcome.out.find("usage: pcl_slam6d", usage + 1), std::string::npos);
}

TEST_F(Ranks, BetweenTwoAddressesTheBytesAreTheSame)
{
  const std::string names = std::to_string(::getpid());
  const std::string one = "pcl6da" + names, other = "pcl6db" + names;
  const auto sh = [](const std::string& command) {
    return bp::system(
        "/bin/sh", "-c", command + " 2>/dev/null", bp::std_out > bp::null);
  };
  const std::string link =
      "ip link add v0 netns " + one + " type veth peer name v0 netns ";
  const auto up = [](const std::string& name, const std::string& address) {
    const std::string in = " && ip -n " + name;
    return in + " addr add " + address + "/24 dev v0" + in + " link set lo up" + in +
           " link set v0 up";
  };
  const auto clean = [&] { sh("ip netns del " + one + "; ip netns del " + other); };
  if (sh("ip netns add " + one + " && ip netns add " + other + " && " + link + other +
         up(one, "10.77.0.1") + up(other, "10.77.0.2")) != 0) {
    clean();
    GTEST_SKIP() << "no network namespaces can be made here";
  }
  // Stands for ssh to another machine.
  const fs::path agent = folder / "agent";
  std::ofstream(agent) << "#!/bin/sh\nshift\nexec ip netns exec " + other +
                              " sh -c \"$*\"\n";
  fs::permissions(agent, fs::perms::owner_all);
  std::istringstream launcher("netns exec " + one +
                              " mpirun --host 10.77.0.1:1,10.77.0.2:1"
                              " --mca btl tcp,self"
                              " --mca btl_tcp_if_include 10.77.0.0/24"
                              " --mca oob_tcp_if_include 10.77.0.0/24"
                              " --mca plm_rsh_agent");
  std::vector<std::string> arguments{std::istream_iterator<std::string>(launcher), {}};
  arguments.push_back(agent.string());
  const auto program = words(2);
  arguments.insert(arguments.end(), program.begin(), program.end());
  const Outcome outcome = run(arguments, "ip");
  clean();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(withoutTimes(out), alone());
}
