// SPDX-License-Identifier: BSD-3-Clause
// Turns results of the suite into numbers. The first argument says which.
#include "evaluate/verbs.h"

int
main(int argc, char** argv)
{
  using namespace pcl6d::app;
  return runVerbs(
      {kEvaluate,
       "WHAT ...",
       "evaluate",
       "Measures results against a reference, or without one.",
       {{"changes", "RUN_A RUN_B", "differences between two runs", runChanges},
        {"trajectory", "ESTIMATE REFERENCE", "errors of a trajectory", runTrajectory},
        {"icp", "SCAN_A SCAN_B", "from how far off ICP finds the pose of B", runIcp},
        {"lengths", "FILE", "ratios of lengths", runLengths},
        {"map", "RUN_DIR", "how good a map is, without a reference", runMap},
        {"place",
         "SCAN RUN, or SCAN_A SCAN_B",
         "place recognition, without an initial pose",
         runPlace},
        {"verify", "RUN, or SCAN_A SCAN_B", "is a map, or a pose, right", runVerify},
        {"mcl", "SCAN_DIR --map FILE", "a reference path in a known plan", runMcl},
        {"suite", "SUITE.json", "several methods over several data sets", runSuite}}},
      argc,
      argv);
}
