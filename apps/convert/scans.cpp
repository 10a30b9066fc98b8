// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/open_scans.h"
#include "common/output/output_folder.h"
#include "common/process/interrupt.h"
#include "common/progress_bar.h"
#include "convert/loss_tally.h"
#include "convert/scan_jobs.h"
#include "convert/verbs.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/scan_name.h>
#include <pcl6d/io/text.h>
#include <pcl6d/io/trajectory_io.h>

#include <iostream>
#include <set>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

/** Options that keep points and poses unchanged. */
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

/** \return whether the pose file of a scan is the input's pose file */
bool
isPoseOf(const fs::path& scan, const fs::path& input)
{
  std::error_code missing;
  return fs::equivalent(poseBeside(scan), poseBeside(input), missing);
}

/** Writes 3DTK's pose of a scan beside the scan, unless the file is an input. */
void
writePoseBeside(const fs::path& scan,
                const Eigen::Isometry3d& pose,
                const fs::path& input)
{
  if (!isPoseOf(scan, input))
    writeUosPose(poseBeside(scan), pose);
}

/** Checks before writing a scan whether its pose can be written; an existing pose file
 * without its scan belongs to other data. */
void
requirePoseBeside(const fs::path& scan, const fs::path& input)
{
  const fs::path file = poseBeside(scan);
  std::error_code missing;
  if (isPoseOf(scan, input))
    return;
  if (fs::exists(file, missing) && !fs::exists(scan, missing))
    throw IoFailed(file.string() +
                   ": already exists, and would be replaced by the pose of " +
                   scan.string() + "; use another name");
  requireWritable(file);
}

/** \brief Writes the scans of a folder, with poses if the format has them. */
class FolderConversion {
public:
  explicit FolderConversion(const ScanSettings& settings)
  : settings_(settings)
  , source_(openScans(settings.input, asTheyAre(settings.folder)))
  , out_(rules(settings))
  , bar_(settings.quiet)
  , uos_(isUos(settings.writer.format))
  , pcd_(settings.writer.format == ScanFormat::kPcd)
  , ptx_(settings.writer.format == ScanFormat::kPtx)
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
              << source_.folder().formatName() << " to "
              << toString(settings_.writer.format) << '\n';
    describePoses();
    losses_.print();
    return losses_.evaluate(bar_);
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
    // Names of stations may contain any character, so files are numbered.
    const std::string stem = folder.sharesFile(i) ? scanName(folder.index(i))
                                                  : folder.file(i).stem().string();
    const std::string name = stem + extensionOf(settings_.writer.format);
    if (!names_.insert(name).second)
      throw IoFailed(folder.file(i).string() +
                     ": another scan has an equal name except for the extension");
    const ScanCloud scan = folder.readCloud(i);
    points_ += std::size_t{scan.cloud.width} * scan.cloud.height;
    losses_.addScan(
        folder.name(i),
        scan,
        writeScan(out_ / name,
                  scan.cloud,
                  pcd_ || ptx_ ? source_.pose(i) : Eigen::Isometry3d::Identity(),
                  settings_.writer));
    if (uos_ && folder.hasPoses())
      writeUosPose((out_ / name).replace_extension(".pose"), source_.pose(i));
  }

  /** poses.txt also for PCD and PTX with stamps, which these formats cannot store. */
  void
  writePoses()
  {
    const ScanFolder& folder = source_.folder();
    const bool has_stamps = !folder.stamps().empty();
    if (uos_ && has_stamps)
      losses_.add("dropped the stamps of the poses");
    if (uos_ || !folder.hasPoses() || ((pcd_ || ptx_) && !has_stamps))
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
                              : ptx_ ? "the headers"
                                     : "poses.txt";
    if (source_.folder().hasPoses())
      std::cout << "poses from " << source_.poseSource() << ", now in " << place
                << '\n';
    else
      std::cout << "no poses found or written\n";
  }

  const ScanSettings& settings_;
  const RegisteredScans source_;
  OutputFolder out_;
  const Interrupt interrupt_;
  ProgressBar bar_;
  bool uos_;
  bool pcd_;
  bool ptx_;
  std::set<std::string> names_;
  std::size_t points_ = 0;
  LossTally losses_;
};
} // namespace

int
convertFile(const ScanSettings& settings)
{
  const ScanCloud scan = readScanCloud(settings.input, readingOf(settings));
  const auto pose = fs::is_regular_file(settings.input) // a pipe cannot be read again
                        ? findScanPose(settings.input, settings.folder.format)
                        : std::nullopt;
  const ScanFormat format = settings.writer.format;
  const bool keeps_pose = format == ScanFormat::kPcd || format == ScanFormat::kPtx;
  const bool has_pose_file = pose && isUos(format) && !isStream(settings.output);
  if (has_pose_file)
    requirePoseBeside(settings.output, settings.input);
  LossTally losses;
  losses.addScan(settings.input,
                 scan,
                 writeScan(settings.output,
                           scan.cloud,
                           keeps_pose && pose ? *pose : Eigen::Isometry3d::Identity(),
                           settings.writer));
  if (has_pose_file)
    writePoseBeside(settings.output, *pose, settings.input);
  else if (pose && !keeps_pose)
    losses.add("dropped the pose");
  ProgressBar bar(settings.quiet);
  if (!settings.without_effect.empty())
    bar.warn(settings.without_effect);
  std::cout << text::counted(std::size_t{scan.cloud.width} * scan.cloud.height, "point")
            << " to " << toString(format) << '\n';
  losses.print();
  return losses.evaluate(bar);
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
  const bool is_folder = fs::is_directory(settings.input) || holdsScans(settings.input);
  const int code = settings.to_e57 ? convertToE57(settings)
                   : settings.full ? joinScans(settings)
                   : is_folder     ? convertFolder(settings)
                                   : convertFile(settings);
  flushOutput();
  return code;
}

} // namespace pcl6d::app
