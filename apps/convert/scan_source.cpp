// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "convert/scan_source.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/io/run_summary.h>
#include <pcl6d/io/scan_name.h>

#include <charconv>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

constexpr const char* kSummary = "summary.json";

/** \return the folder that holds the scans: that of a run has them in a folder of its own
 */
ScanFolder
openFolder(const ScanSettings& settings, bool is_run)
{
  if (!is_run)
    return ScanFolder(settings.input, settings.folder);
  if (!settings.folder.poses_file.empty())
    throw UsageError("--poses = " + settings.folder.poses_file.string() +
                     ", but the run in " + settings.input.string() +
                     " has poses of its own");
  if (!fs::is_directory(settings.input / "scans"))
    throw IoFailed(settings.input.string() +
                   ": the run was interrupted and holds no scans");
  return ScanFolder(settings.input / "scans", settings.folder);
}

/** \return the option's value [m] \throws IoFailed it is none */
double
lengthOf(const RunSummary& summary, const std::string& name, const fs::path& file)
{
  for (const auto& option : summary.options) {
    if (option.name != name)
      continue;
    double value = 0;
    const char* const end = option.value.data() + option.value.size();
    if (std::from_chars(option.value.data(), end, value).ptr != end)
      throw IoFailed(file.string() + ": " + name + " = '" + option.value +
                     "' is not a number");
    return value;
  }
  throw IoFailed(file.string() + ": the options have no " + name);
}

/** \return the number of a scan that the run wrote */
std::uint32_t
indexOf(const fs::path& scan, const RunSummary& summary)
{
  for (const auto& entry : summary.scans)
    if (scanName(entry.index) == scan.stem().string())
      return static_cast<std::uint32_t>(entry.index);
  throw IoFailed(scan.string() + ": the summary of the run does not tell of this scan");
}
} // namespace

ScanSource::ScanSource(const ScanSettings& settings)
: is_run_(fs::exists(settings.input / kSummary))
, folder_(openFolder(settings, is_run_))
, world_offset_(pcl6d::worldOffset(folder_.initialPose(0)))
{
  for (std::size_t i = 0; i < folder_.size(); ++i)
    indices_.push_back(static_cast<std::uint32_t>(folder_.index(i)));
  if (is_run_)
    readRun(settings.input / kSummary);
}

void
ScanSource::readRun(const fs::path& summary_file)
{
  const RunSummary summary = readRunSummary(summary_file);
  world_offset_ = summary.world_offset;
  min_range_ = lengthOf(summary, "min-range", summary_file);
  max_range_ = lengthOf(summary, "max-range", summary_file);
  for (std::size_t i = 0; i < folder_.size(); ++i)
    indices_[i] = indexOf(folder_.file(i), summary);
}

Eigen::Isometry3d
ScanSource::pose(std::size_t i) const
{
  Eigen::Isometry3d pose = folder_.initialPose(i);
  if (is_run_) // its VIEWPOINTs are relative
    pose.translation() += world_offset_;
  return pose;
}

std::string
ScanSource::poseSource() const
{
  return is_run_ ? "the run" : folder_.poseSource();
}

} // namespace pcl6d::app
