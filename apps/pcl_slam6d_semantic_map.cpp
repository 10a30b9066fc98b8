// SPDX-License-Identifier: BSD-3-Clause
// Semantic maps of finished runs. The first argument says what to do.
#include "semantic_map/verbs.h"

int
main(int argc, char** argv)
{
  using namespace pcl6d::app;
  return runVerbs({kSemanticMap,
                   "JOB ...",
                   "do",
                   "Makes and asks semantic maps: planes with labels, objects, rooms.",
                   {{"build",
                     "RUN_DIR",
                     "make the semantic map of a run of pcl_slam6d",
                     runMapBuild},
                    {"query",
                     "MAP \"...\"",
                     "find things, such as \"objects class=chair\"",
                     runMapQuery},
                    {"info", "MAP", "tell what a map holds", runMapInfo}}},
                  argc,
                  argv);
}
