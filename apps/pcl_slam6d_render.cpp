// SPDX-License-Identifier: BSD-3-Clause
// Shows what a run of pcl_slam6d left. The first argument says how.
#include "render/verbs.h"

int
main(int argc, char** argv)
{
  using namespace pcl6d::app;
  return runVerbs(
      {kRender,
       "JOB RUN ...",
       "do",
       "Shows what a run of pcl_slam6d left in the folder RUN. Needs no display.",
       {{"animation",
         "",
         "the map growing, relaxing, turning or flown through, as frames and a video",
         runAnimation},
        {"picture",
         "",
         "views of the map, the poses and the links as PNG files",
         runPicture},
        {"report",
         "",
         "one page for a browser: verdict, map, plots, tables, pictures",
         runReport}}},
      argc,
      argv);
}
