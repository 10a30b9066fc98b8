// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/option_names.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/io/scan_name.h>
#include <pcl6d/io/text.h>
#include <pcl6d/run/registered_scans.h>
#include <pcl6d/run/run_folder.h>

#include <charconv>
#include <utility>

namespace pcl6d {

namespace {
namespace fs = std::filesystem;

constexpr const char* kRunSummary = "summary.json";

std::optional<RunResult>
summaryOf(const fs::path& folder)
{
  if (!text::isThere(folder / kRunSummary))
    return {};
  const RunFolder run(folder);
  run.requireWhole("scans/"); // the scans are read from files
  return run.summary();
}

/** \return the folder of the scans: for a run, its subfolder scans/ */
ScanFolder
openFolder(const fs::path& path, const ScanFolderOptions& options, bool is_run)
{
  if (!is_run)
    return ScanFolder(path, options);
  ScanFolderOptions near = options; // the run has moved far points
  near.keep_coordinates = true;
  if (!options.poses_file.empty())
    throw BadArgument("poses_file = " + options.poses_file.string() +
                      ", but the run in " + path.string() + " has poses of its own");
  if (!fs::is_directory(path / "scans"))
    throw IoFailed(path.string() + ": the run was interrupted and holds no scans");
  return ScanFolder(path / "scans", near);
}

/** \return the number of a scan written by the run */
std::uint32_t
indexOf(const fs::path& scan, const RunResult& summary)
{
  for (const auto& entry : summary.scans)
    if (scanName(entry.index) == scan.stem().string())
      return static_cast<std::uint32_t>(entry.index);
  throw IoFailed(scan.string() + ": the summary of the run lacks the scan");
}
} // namespace

double
lengthOfRun(const RunResult& summary, const std::string& name, const fs::path& file)
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

RegisteredScans::RegisteredScans(const fs::path& path, const ScanFolderOptions& options)
: summary_(summaryOf(path))
, folder_(openFolder(path, options, summary_.has_value()))
, world_offset_(pcl6d::worldOffset(folder_.initialPose(0)))
{
  for (std::size_t i = 0; i < folder_.size(); ++i)
    indices_.push_back(static_cast<std::uint32_t>(folder_.index(i)));
  if (summary_)
    readRun(path / kRunSummary);
}

RegisteredScans::RegisteredScans(ScanFolder folder)
: folder_(std::move(folder)), world_offset_(pcl6d::worldOffset(folder_.initialPose(0)))
{
  for (std::size_t i = 0; i < folder_.size(); ++i)
    indices_.push_back(static_cast<std::uint32_t>(folder_.index(i)));
}

void
RegisteredScans::readRun(const fs::path& summary_file)
{
  world_offset_ = summary_->world_offset;
  min_range_ = lengthOfRun(*summary_, kMinRangeOption, summary_file);
  max_range_ = lengthOfRun(*summary_, kMaxRangeOption, summary_file);
  for (std::size_t i = 0; i < folder_.size(); ++i)
    indices_[i] = indexOf(folder_.file(i), *summary_);
}

Eigen::Isometry3d
RegisteredScans::pose(std::size_t i) const
{
  Eigen::Isometry3d pose = folder_.initialPose(i);
  if (summary_) // VIEWPOINTs of a run are relative
    pose.translation() += world_offset_;
  return pose;
}

const std::optional<MovedPoints>&
RegisteredScans::moved() const
{
  return summary_ ? summary_->moved : folder_.moved();
}

std::string
RegisteredScans::poseSource() const
{
  return summary_ ? "the run" : folder_.poseSource();
}

} // namespace pcl6d
