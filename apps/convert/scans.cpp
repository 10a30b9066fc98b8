// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/interrupt.h"
#include "common/open_scans.h"
#include "common/output_folder.h"
#include "common/progress_bar.h"
#include "convert/loss_tally.h"
#include "convert/scan_jobs.h"
#include "convert/verbs.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/text.h>
#include <pcl6d/io/trajectory_io.h>

#include <iostream>
#include <set>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

/** Points are written where they are, poses as they were given. */
ScanFolderOptions
asTheyAre(ScanFolderOptions options)
{
  options.keep_coordinates = true;
  return options;
}

bool
isUos(ScanFormat format)
{
  return format == ScanFormat::kUos || format == ScanFormat::kUosr;
}

fs::path
poseBeside(fs::path scan)
{
  return scan.replace_extension(".pose");
}

/** \return whether the pose of a scan is there as that of the input */
bool
isPoseOf(const fs::path& scan, const fs::path& input)
{
  std::error_code missing;
  return fs::equivalent(poseBeside(scan), poseBeside(input), missing);
}

/** Writes 3DTK's pose of a scan beside it, unless it is there as an input. */
void
writePoseBeside(const fs::path& scan,
                const Eigen::Isometry3d& pose,
                const fs::path& input)
{
  if (!isPoseOf(scan, input))
    writeUosPose(poseBeside(scan), pose);
}

/** Finds out before a scan is written whether its pose can be; one that is there without its
 * scan is of something else. */
void
requirePoseBeside(const fs::path& scan, const fs::path& input)
{
  const fs::path file = poseBeside(scan);
  std::error_code missing;
  if (isPoseOf(scan, input))
    return;
  if (fs::exists(file, missing) && !fs::exists(scan, missing))
    throw IoFailed(file.string() +
                   ": is there already, and would be replaced by the pose of " +
                   scan.string() + "; use another name");
  requireWritable(file);
}

/** \brief Writes the scans of a folder, and their poses where they belong. */
class FolderConversion {
public:
  explicit FolderConversion(const ScanSettings& settings)
  : settings_(settings)
  , source_(openScans(settings.input, asTheyAre(settings.folder)))
  , out_(rules(settings))
  , bar_(settings.quiet)
  , uos_(isUos(settings.writer.format))
  , pcd_(settings.writer.format == ScanFormat::kPcd)
  {}

  int
  run()
  {
    if (!settings_.without_effect.empty())
      bar_.warn(settings_.without_effect);
    for (std::size_t i = 0; i < source_.folder().size(); ++i) {
      if (interrupt_.requested())
        return kInterrupted;
      convert(i);
      bar_.show({"converting", i + 1, source_.folder().size()});
    }
    writePoses();
    out_.publish();
    std::cout << text::counted(source_.folder().size(), "scan") << ", "
              << text::counted(points_, "point") << ": "
              << toString(source_.folder().format()) << " to "
              << toString(settings_.writer.format) << '\n';
    describePoses();
    losses_.print();
    return losses_.judge(bar_);
  }

private:
  static OutputRules
  rules(const ScanSettings& settings)
  {
    OutputRules rules;
    rules.folder = settings.output;
    rules.inputs = {settings.input, settings.folder.poses_file};
    rules.program = kConvert;
    return rules;
  }

  void
  convert(std::size_t i)
  {
    const ScanFolder& folder = source_.folder();
    const std::string name =
        folder.file(i).stem().string() + extensionOf(settings_.writer.format);
    if (!names_.insert(name).second)
      throw IoFailed(folder.file(i).string() +
                     ": another scan has the same name but for the extension");
    const ScanCloud scan = folder.readCloud(i);
    points_ += std::size_t{scan.cloud.width} * scan.cloud.height;
    losses_.addScan(folder.name(i),
                    scan,
                    writeScan(out_ / name,
                              scan.cloud,
                              pcd_ ? source_.pose(i) : Eigen::Isometry3d::Identity(),
                              settings_.writer));
    if (uos_ && folder.hasPoses())
      writeUosPose((out_ / name).replace_extension(".pose"), source_.pose(i));
  }

  /** poses.txt also for PCD if there are stamps, which VIEWPOINT does not hold. */
  void
  writePoses()
  {
    const ScanFolder& folder = source_.folder();
    const bool has_stamps = !folder.stamps().empty();
    if (uos_ && has_stamps)
      losses_.add("dropped the stamps of the poses");
    if (uos_ || !folder.hasPoses() || (pcd_ && !has_stamps))
      return;
    Trajectory trajectory;
    for (std::size_t i = 0; i < folder.size(); ++i)
      trajectory.poses.push_back(source_.pose(i));
    trajectory.stamps = folder.stamps();
    has_stamps ? writeTrajectoryTum(out_ / "poses.txt", trajectory)
               : writeTrajectoryKitti(out_ / "poses.txt", trajectory);
  }

  void
  describePoses() const
  {
    const char* const place = uos_   ? "the .pose files"
                              : pcd_ ? "VIEWPOINT"
                                     : "poses.txt";
    if (source_.folder().hasPoses())
      std::cout << "poses from " << source_.poseSource() << ", now in " << place
                << '\n';
    else
      std::cout << "no poses found, none written\n";
  }

  const ScanSettings& settings_;
  const RegisteredScans source_;
  OutputFolder out_;
  const Interrupt interrupt_;
  ProgressBar bar_;
  bool uos_;
  bool pcd_;
  std::set<std::string> names_;
  std::size_t points_ = 0;
  LossTally losses_;
};
} // namespace

int
convertFile(const ScanSettings& settings)
{
  const ScanCloud scan = readScanCloud(settings.input, settings.folder.format);
  const auto pose = fs::is_regular_file(settings.input) // a pipe cannot be read again
                        ? findScanPose(settings.input, settings.folder.format)
                        : std::nullopt;
  const ScanFormat format = settings.writer.format;
  const bool has_pose_file = pose && isUos(format) && !isStream(settings.output);
  if (has_pose_file)
    requirePoseBeside(settings.output, settings.input);
  LossTally losses;
  losses.addScan(settings.input,
                 scan,
                 writeScan(settings.output,
                           scan.cloud,
                           format == ScanFormat::kPcd && pose
                               ? *pose
                               : Eigen::Isometry3d::Identity(),
                           settings.writer));
  if (has_pose_file)
    writePoseBeside(settings.output, *pose, settings.input);
  else if (pose && format != ScanFormat::kPcd)
    losses.add("dropped the pose");
  ProgressBar bar(settings.quiet);
  if (!settings.without_effect.empty())
    bar.warn(settings.without_effect);
  std::cout << text::counted(std::size_t{scan.cloud.width} * scan.cloud.height, "point")
            << " to " << toString(format) << '\n';
  losses.print();
  return losses.judge(bar);
}

int
convertFolder(const ScanSettings& settings)
{
  return FolderConversion(settings).run();
}

int
runScans(const std::vector<std::string>& arguments)
{
  ScanSettings settings;
  if (!parseScanSettings(arguments, settings))
    return kDone;
  const MemoryBudget memory(settings.memory, settings.output);
  const int code = settings.full                      ? joinScans(settings)
                   : fs::is_directory(settings.input) ? convertFolder(settings)
                                                      : convertFile(settings);
  flushOutput();
  return code;
}

} // namespace pcl6d::app
