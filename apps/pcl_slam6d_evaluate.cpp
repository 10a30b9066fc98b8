// SPDX-License-Identifier: BSD-3-Clause
// Measures results against a reference. The first argument says what to evaluate.
#include "common/app.h"
#include "evaluate/verbs.h"

#include <iostream>

namespace {
using namespace pcl6d;

int
run(const std::vector<std::string>& arguments)
{
  const std::string verbs = "trajectory, icp, mcl";
  if (arguments.empty())
    throw app::UsageError("the first argument must say what to evaluate: " + verbs);
  const std::string& verb = arguments.front();
  if (verb == "trajectory")
    return app::runTrajectory({arguments.begin() + 1, arguments.end()});
  if (verb == "icp")
    return app::runIcp({arguments.begin() + 1, arguments.end()});
  if (verb == "mcl")
    return app::runMcl({arguments.begin() + 1, arguments.end()});
  if (verb == "--version")
    return app::runTrajectory({verb});
  if (verb != "--help" && verb != "-h")
    throw app::UsageError("cannot evaluate '" + verb + "', but only: " + verbs);
  std::cout
      << "usage: " << app::kEvaluate << " WHAT ...\n"
      << "Measures results against a reference.\n\n"
      << "  trajectory ESTIMATE REFERENCE   errors of a trajectory\n"
      << "  icp SCAN_A SCAN_B               from how far off ICP finds the pose of "
         "B\n"
      << "  mcl SCAN_DIR --map FILE         a reference path in a known plan\n\n"
      << app::kEvaluate << " WHAT --help tells the options.\n";
  return app::kDone;
}
} // namespace

int
main(int argc, char** argv)
{
  return app::runMain(app::kEvaluate, argc, argv, run);
}
