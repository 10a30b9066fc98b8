// SPDX-License-Identifier: BSD-3-Clause
// Turns results of the suite into numbers. The first argument says which.
#include "common/app.h"
#include "evaluate/verbs.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <iterator>

namespace {
using namespace pcl6d;

/** A job of the program. */
struct Job {
  const char* verb;
  const char* arguments;
  const char* what;
  int (*run)(const std::vector<std::string>& arguments);
};

constexpr Job kJobs[] = {
    {"trajectory", "ESTIMATE REFERENCE", "errors of a trajectory", app::runTrajectory},
    {"icp", "SCAN_A SCAN_B", "from how far off ICP finds the pose of B", app::runIcp},
    {"lengths", "FILE", "ratios of lengths", app::runLengths},
    {"map", "RUN_DIR", "how good a map is, without a reference", app::runMap},
    {"mcl", "SCAN_DIR --map FILE", "a reference path in a known plan", app::runMcl},
    {"suite", "SUITE.json", "several methods over several data sets", app::runSuite},
};

std::string
verbs()
{
  std::string all;
  for (const Job& job : kJobs)
    all += (all.empty() ? "" : ", ") + std::string(job.verb);
  return all;
}

void
printHelp()
{
  std::cout << "usage: " << app::kEvaluate << " WHAT ...\n"
            << "Measures results against a reference, or without one.\n\n";
  for (const Job& job : kJobs) {
    char line[128];
    const std::string call = std::string(job.verb) + " " + job.arguments;
    std::snprintf(line, sizeof line, "  %-31s %s\n", call.c_str(), job.what);
    std::cout << line;
  }
  std::cout << '\n' << app::kEvaluate << " WHAT --help tells the options.\n";
}

int
run(const std::vector<std::string>& arguments)
{
  if (arguments.empty())
    throw app::UsageError("the first argument must say what to evaluate: " + verbs());
  const std::string& verb = arguments.front();
  const auto job = std::find_if(std::begin(kJobs), std::end(kJobs), [&](const Job& j) {
    return verb == j.verb;
  });
  if (job != std::end(kJobs))
    return job->run({arguments.begin() + 1, arguments.end()});
  if (verb == "--version")
    return app::runTrajectory({verb});
  if (verb != "--help" && verb != "-h")
    throw app::UsageError("cannot evaluate '" + verb + "', but only: " + verbs());
  printHelp();
  return app::kDone;
}
} // namespace

int
main(int argc, char** argv)
{
  return app::runMain(app::kEvaluate, argc, argv, run);
}
