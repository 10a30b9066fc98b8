// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/command_line.h"
#include "convert/verbs.h"

#include <pcl6d/io/trajectory_io.h>

namespace pcl6d::app {

int
runTrajectory(const std::vector<std::string>& arguments)
{
  namespace po = boost::program_options;
  std::string input, output;
  CommandLine line(std::string("usage: ") + kConvert +
                   " trajectory IN -o OUT\nWrites poses (KITTI or TUM) as KITTI "
                   "rows.\n");
  line.positional("IN", &input);
  line.group("Output").add_options()(
      "output,o", po::value(&output)->value_name("OUT")->required(), "KITTI file");
  if (line.parse(arguments))
    writeTrajectoryKitti(output, readTrajectory(input));
  return kDone;
}

} // namespace pcl6d::app
