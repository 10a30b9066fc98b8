// SPDX-License-Identifier: BSD-3-Clause
// Semantic maps of finished runs. The first argument says what to do.
#include "semantic_map/verbs.h"

int
main(int argc, char** argv)
{
  using namespace pcl6d::app;
  return runVerbs(
      {kSemanticMap,
       "JOB ...",
       "do",
       "Makes and queries semantic maps: planes with labels, objects, rooms.",
       {{"build",
         "RUN_DIR",
         "make the semantic map of a run of pcl_slam6d",
         runMapBuild},
        {"query", "MAP \"...\"", "find entities: \"objects class=chair\"", runMapQuery},
        {"info", "MAP", "print the content of a map", runMapInfo}}},
      argc,
      argv);
}
