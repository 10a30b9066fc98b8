// SPDX-License-Identifier: BSD-3-Clause
// Works on pose graphs without scans. The first argument says what to do.
#include "graph/verbs.h"

int
main(int argc, char** argv)
{
  using namespace pcl6d::app;
  return runVerbs(
      {kGraph,
       "JOB ...",
       "do",
       "Works on pose graphs (g2o or TORO files).",
       {{"optimize",
         "IN -o OUT",
         "find the poses that fit the links best",
         runOptimize},
        {"info", "IN", "print the content of a graph", runInfo},
        {"convert", "IN -o OUT", "write a graph as g2o or TORO", runConvert}}},
      argc,
      argv);
}
