// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/command_line.h"
#include "render/verbs.h"

#include <pcl6d/io/run_folder.h>
#include <pcl6d/visualization/top_view.h>

namespace pcl6d::app {

int
runPicture(const std::vector<std::string>& arguments)
{
  std::string input, output;
  CommandLine line(std::string("usage: ") + kRender +
                   " picture RUN -o FILE.png\n"
                   "Draws the map of a run from above.\n");
  line.positional("RUN", &input);
  line.group("Output").add_options()(
      "output,o",
      boost::program_options::value(&output)->value_name("FILE")->required(),
      "PNG file");
  if (!line.parse(arguments))
    return kDone;
  const RunFolder run(input);
  const RunMap map = run.readMap();
  TopViewScene scene;
  scene.points = map.points;
  scene.scans = map.scans;
  scene.trajectory = run.trajectory();
  scene.initial = run.initialTrajectory();
  TopView().write(output, scene);
  return kDone;
}

} // namespace pcl6d::app
