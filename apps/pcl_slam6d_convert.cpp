// SPDX-License-Identifier: BSD-3-Clause
// Turns files of one format into another. The first argument says what to convert.
#include "convert/verbs.h"

int
main(int argc, char** argv)
{
  using namespace pcl6d::app;
  return runVerbs(
      {kConvert,
       "WHAT ...",
       "convert",
       "Converts files between formats.",
       {{"calibrate",
         "PICTURES -o CAMERA.yml",
         "chessboards to a camera",
         runCalibrate},
        {"depth", "IMAGES -o OUT", "depth images to scans", runDepth},
        {"info",
         "FILE|FOLDER",
         "print the content of a scan, a folder or a site",
         runInfo},
        {"lines", "LINES.csv -o OUT.pcd", "2D lines on a drive as a 3D scan", runLines},
        {"map", "RUN -o FILE", "a run as a map for planners, or a recording", runMap},
        {"poses",
         "RUN -o OUT.e57 --into SITE.e57",
         "poses of a run into the E57 file",
         runPoses},
        {"scans", "IN -o OUT", "scans in another format", runScans},
        {"stereo", "LEFT RIGHT CALIB -o OUT", "two pictures to a scan", runStereo},
        {"trajectory", "IN -o OUT", "poses in another format", runTrajectory}}},
      argc,
      argv);
}
