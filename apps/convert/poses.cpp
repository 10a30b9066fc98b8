// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "convert/verbs.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/run_result.h>
#include <pcl6d/io/text.h>
#include <pcl6d/run/run_folder.h>
#include <pcl6d/sources/e57_poses.h>
#include <pcl6d/sources/e57_source.h>

#include <iostream>

namespace pcl6d::app {

namespace {
constexpr const char* kPosesUsage =
    R"( poses RUN -o OUT.e57 --into SITE.e57
Copies an E57 file with the poses that pcl_slam6d has found for its scans. Only the
pose elements and the checksums of their pages change: points, images, names and
extensions stay byte for byte. RUN is the folder of the run of that file.
)";

struct PoseSettings {
  std::string run;
  std::string output;
  std::string into;
};

bool
parsePoseSettings(const std::vector<std::string>& arguments, PoseSettings& s)
{
  OptionTable table(std::string("usage: ") + kConvert + kPosesUsage);
  table.positional("RUN", &s.run);
  table.group("Files");
  table.add("output,o OUT", &s.output).required().help("E57 file to write");
  table.add("into SITE", &s.into).required().help("E57 file registered by the run");
  if (!table.parse(arguments))
    return false;
  refuseInputs(s.output, {s.run, s.into}, "the input");
  return true;
}

/** \return the pose for a scan's points as stored in the file */
Eigen::Isometry3d
poseOfFile(const ScanResult& scan, const std::optional<MovedPoints>& moved)
{
  return moved ? scan.T_world_scan * moved->toNear(moved->asGiven(scan.initial_pose))
               : scan.T_world_scan;
}

/** \return the pose of each scan of the file, if contained in the run */
std::vector<std::optional<Eigen::Isometry3d>>
posesOf(const RunFolder& run, const E57Source& site)
{
  std::vector<std::optional<Eigen::Isometry3d>> poses(site.scans().size());
  for (const auto& scan : run.summary().scans) {
    const auto number = static_cast<std::size_t>(scan.index);
    if (number >= poses.size() || site.scans()[number].name != scan.file)
      throw IoFailed(site.path().string() + ": is not the file that the run in " +
                     run.path().string() + " has registered: its scan " +
                     std::to_string(number) +
                     (number >= poses.size()
                          ? " is missing"
                          : " is called " + text::quoted(site.scans()[number].name)) +
                     ", the run has " + text::quoted(scan.file));
    poses[number] = poseOfFile(scan, run.summary().moved);
  }
  return poses;
}
} // namespace

int
runPoses(const std::vector<std::string>& arguments)
{
  PoseSettings settings;
  if (!parsePoseSettings(arguments, settings))
    return kDone;
  const RunFolder run =
      RunFolder::finished(settings.run, "the run was interrupted; start the run again");
  const E57Source site(settings.into);
  const auto poses = posesOf(run, site);
  writeE57Poses(settings.into, settings.output, poses);
  const std::size_t written = run.summary().scans.size();
  std::cout << text::counted(written, "pose") << " of "
            << text::counted(site.scans().size(), "scan") << " written\n";
  const std::size_t predicted = countScans(run.summary().scans, ScanState::kPredicted);
  if (predicted > 0)
    std::cout << text::counted(predicted, "scan")
              << " could not be registered: the poses are predicted from the "
                 "registered scans\n";
  flushOutput();
  return kDone;
}

} // namespace pcl6d::app
