// SPDX-License-Identifier: BSD-3-Clause
// Finds objects in scans and learns what they look like. The first argument says what to
// do.
#include "objects/verbs.h"

int
main(int argc, char** argv)
{
  using namespace pcl6d::app;
  return runVerbs({kObjects,
                   "JOB ...",
                   "do",
                   "Finds objects in scans and trains detectors of objects.",
                   {{"locate",
                     "INPUT --model MODEL... -o OUT_DIR",
                     "objects and their poses",
                     runLocate},
                    {"targets",
                     "SCANS -o targets.csv",
                     "spheres and boards of a survey",
                     runTargets},
                    {"train",
                     "MODEL... --background SCANS -o CASCADE.xml",
                     "a detector from models",
                     runTrain}}},
                  argc,
                  argv);
}
