// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "common/options/reduction_options.h"
#include "localize/localize_settings.h"

namespace pcl6d::app {

namespace {
void
addRows(OptionTable& table, LocalizeSettings& s, std::vector<std::string>& inputs)
{
  table.positional("RUN", &s.run);
  table.positionals("SCANS", &inputs);
  table.group("Output");
  table.add("output,o OUT_DIR", &s.out).required().help("folder to write");
  table.add("force", &s.force).help("accept an OUT_DIR that is not empty");
  table.group("Input");
  table.add("format", &s.folder.format, scanFormatFromName)
      .help("auto|pcd|ply|uos|kitti|xyz|las|laz|ptx|pts|csv|txt");
  table.add("poses FILE", &s.folder.poses_file)
      .help("odometry of the scans, KITTI or TUM rows in any world (default: *.pose, "
            "odometry.txt, poses.txt, PCD VIEWPOINT; constant velocity without poses)");
  table.add("first", &s.folder.first).help("index of the first scan to take");
  table.add("last", &s.folder.last)
      .help("index of the last scan to take (default: the end)");
  table.add("every", &s.folder.every).help("take each n-th scan");
  table.group("Range gate and reduction; auto: values of the run");
  addReductionOptions(table, s.parameters);
  table.group("Run");
  table.addAs<int>("threads", &s.num_threads)
      .within(0, 1024, "in [0, 1024]")
      .help("0: a thread per core; never changes the result");
  table.add("quiet", &s.quiet).help("print warnings and errors only");
}
} // namespace

bool
parseLocalizeSettings(const std::vector<std::string>& arguments, LocalizeSettings& s)
{
  OptionTable table(std::string("usage: ") + kLocalize +
                    R"( RUN SCANS ... -o OUT_DIR [options]
Finds the poses of further scans in the map of a finished run of pcl_slam6d, without
changing the map. SCANS: a folder, or one or several files. The first scan is searched in
the whole map; each further scan near the scan before, by odometry or constant velocity,
and in the whole map if not found. Points and rays decide; a scan with several possible
places, or without a place, has no pose.
Exit code 0: every scan has a pose; 3: at least one scan has no pose.
)");
  std::vector<std::string> inputs;
  addRows(table, s, inputs);
  if (!table.parse(arguments))
    return false;
  s.inputs.assign(inputs.begin(), inputs.end());
  table.check(
      [&] {
        s.folder.validate();
        s.parameters.validate();
      },
      {{"poses_file", "poses"}});
  return true;
}

} // namespace pcl6d::app
