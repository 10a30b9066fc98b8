// SPDX-License-Identifier: BSD-3-Clause
// pcl6d_faults: breaks inputs of all kinds in thousands of ways and looks whether the
// programs meet them with words (test/faults/run.sh).
#include "accepted.h"
#include "extreme_options.h"
#include "round_report.h"
#include "runner.h"
#include "samples.h"
#include "support/temp_folder.h"
#include "targets.h"

#include <boost/program_options.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <random>
#include <regex>
#include <stdexcept>

namespace {
namespace fs = std::filesystem;
namespace po = boost::program_options;
using namespace pcl6d::faults;

struct Settings {
  std::size_t sample = 0;
  std::uint64_t seed = 1;
  std::size_t jobs = 1;
  double time_limit = 20;
  double seconds = 0;
  std::string keep, pattern, programs = PCL6D_BIN_DIR;
  bool list = false;
};

po::options_description
describe(Settings& s)
{
  po::options_description options("options");
  auto add = options.add_options();
  add("sample", po::value(&s.sample), "so many cases, spread over all; default: all");
  add("seed", po::value(&s.seed), "of what is broken where");
  add("jobs", po::value(&s.jobs), "programs at once");
  add("time-limit", po::value(&s.time_limit), "[s] of a program");
  add("seconds",
      po::value(&s.seconds),
      "[s] from the first case on, after which none is begun, in a mixed order; "
      "default: no end");
  add("keep", po::value(&s.keep), "folder that gets the inputs of each finding");
  add("pattern",
      po::value(&s.pattern),
      "regular expression: only cases with such names");
  add("programs", po::value(&s.programs), "folder of the programs");
  add("list", po::bool_switch(&s.list), "print the names of the cases, run none");
  add("help", "print this text");
  return options;
}

std::vector<Case>
casesOf(const Settings& s, const fs::path& samples, const fs::path& scratch)
{
  const fs::path tables = PCL6D_SOURCE_DIR "/test/faults";
  std::vector<Case> all =
      brokenInputCases(readTargets(tables / "targets.txt"), samples, s.seed);
  for (Case& one :
       extremeOptionCases(tables / "calls.txt", s.programs, scratch / "help", s.seed))
    all.push_back(std::move(one));
  std::vector<Case> chosen;
  const std::regex pattern(s.pattern);
  for (Case& one : all)
    if (s.pattern.empty() || std::regex_search(one.name, pattern))
      chosen.push_back(std::move(one));
  std::vector<Case> spread;
  const std::size_t count =
      s.sample == 0 ? chosen.size() : std::min(s.sample, chosen.size());
  for (std::size_t i = 0; i < count; ++i)
    spread.push_back(std::move(chosen[i * chosen.size() / count]));
  if (s.seconds > 0) // so that what is left out is not always the last programs
    std::shuffle(spread.begin(), spread.end(), std::mt19937_64(s.seed));
  return spread;
}

/** Copies the inputs of a case once more, for who wants to look. */
void
keep(const Case& one, const Trace& trace, const Settings& s, const fs::path& samples)
{
  std::string name = one.name;
  for (char& c : name)
    if (c == '/' || c == ' ')
      c = '_';
  const fs::path place = fs::path(s.keep) / name;
  fs::remove_all(place);
  prepare(one, samples, place / "in");
  const Command command = commandOf(one, s.programs, place);
  pcl6d::test::writeText(place / "command", shellLine(command) + '\n');
  pcl6d::test::writeText(place / "stdout", trace.out);
  pcl6d::test::writeText(place / "stderr", trace.err);
}

int
run(const Settings& s)
{
  const pcl6d::test::TempFolder folder;
  const fs::path samples = folder / "samples";
  std::cerr << "samples ..." << std::endl;
  makeSamples(s.programs, PCL6D_SOURCE_DIR "/share", samples);
  const std::vector<Case> cases = casesOf(s, samples, folder.path());
  if (s.list)
    for (const Case& one : cases)
      std::cout << one.name << '\n';
  if (s.list)
    return 0;
  auto acceptances = readAcceptances(PCL6D_SOURCE_DIR "/test/faults/accepted.txt");
  RoundReport report(s.seed);
  RunnerOptions options;
  options.programs = s.programs;
  options.samples = samples;
  options.scratch = folder / "scratch";
  options.jobs = s.jobs;
  options.limits.seconds = s.time_limit;
  if (s.seconds > 0) // from here on: on a busy machine the samples alone take minutes
    options.last_start =
        std::chrono::steady_clock::now() +
        std::chrono::milliseconds(static_cast<std::int64_t>(1000 * s.seconds));
  runCases(cases, options, [&](const Case& one, const Trace& trace) {
    std::vector<Finding> findings;
    for (const Finding& finding : evaluate(one, trace))
      if (!isAccepted(one, finding, acceptances))
        findings.push_back(finding);
    std::cout << report.add(one, trace, findings) << std::flush;
    if (!findings.empty() && !s.keep.empty())
      keep(one, trace, s, samples);
    if (report.cases() % 100 == 0)
      std::cerr << report.cases() << " of " << cases.size() << " cases, "
                << report.findings() << " findings" << std::endl;
  });
  std::cout << report.table(acceptances);
  std::cout << "faults: " << report.cases() << " of " << cases.size() << " cases\n";
  if (report.cases() == 0)
    throw std::runtime_error("no case was run: none has such a name");
  return report.findings() == 0 ? 0 : 1;
}
} // namespace

int
main(int argc, char** argv)
try {
  Settings settings;
  const po::options_description options = describe(settings);
  po::positional_options_description words;
  words.add("pattern", 1);
  po::variables_map map;
  po::store(
      po::command_line_parser(argc, argv).options(options).positional(words).run(),
      map);
  if (map.count("help")) {
    std::cout << "usage: test/faults/run.sh [options] [PATTERN]\n" << options;
    return 0;
  }
  po::notify(map);
  return run(settings);
} catch (const po::error& e) {
  std::cerr << "pcl6d_faults: error: " << e.what() << " (see --help)\n";
  return 2;
} catch (const std::exception& e) {
  std::cerr << "pcl6d_faults: error: " << e.what() << '\n';
  return 2;
}
