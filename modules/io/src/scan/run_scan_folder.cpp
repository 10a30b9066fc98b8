// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/scan_name.h>
#include <pcl6d/io/text.h>
#include <pcl6d/io/trajectory_io.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace pcl6d {

namespace fs = std::filesystem;

namespace {
/** \return whether the stamps [s] of scans common with a run equal the scan numbers: a scan a
 * second, which stampsOfRun() treats as missing stamps */
bool
areNumbers(const std::map<std::string, double>& stamps, const RunResult& summary)
{
  std::size_t count = 0;
  for (const auto& scan : summary.scans)
    if (const auto found = stamps.find(scan.file); found != stamps.end()) {
      if (found->second != scan.index)
        return false;
      ++count;
    }
  return count > 0;
}
} // namespace

std::vector<double>
stampsOfRun(const fs::path& run, const RunResult& summary)
{
  const fs::path file = run / "trajectory.tum";
  const std::vector<double> rows = readTrajectory(file).stamps;
  const std::size_t expected =
      summary.drive ? summary.drive->files.size() : summary.scans.size();
  if (rows.size() != expected)
    text::fail(file,
               "holds " + text::counted(rows.size(), "pose") + " for " +
                   text::counted(expected, summary.drive ? "sweep" : "scan"));
  std::vector<double> stamps;
  for (std::size_t i = 0; i < summary.scans.size(); ++i)
    stamps.push_back(summary.drive
                         ? rows.at(summary.drive->placeOf(summary.scans[i].index))
                         : rows[i]);
  for (std::size_t i = 0; i < stamps.size(); ++i)
    if (stamps[i] != summary.scans[i].index)
      return stamps;
  return {};
}

ScanFolder
ScanFolder::ofRuns(const std::vector<Registered>& scans,
                   std::vector<double> stamps,
                   const std::optional<MovedPoints>& moved,
                   const std::string& source)
{
  require(!scans.empty(), "scans", scans.size(), "> 0");
  require(stamps.empty() || stamps.size() == scans.size(),
          "stamps",
          stamps.size(),
          "empty or equal to the number of scans");
  ScanFolder folder;
  for (const Registered& scan : scans) {
    Entry& entry = folder.entries_.emplace_back();
    entry.file = scan.file;
    entry.name = scan.name;
    entry.index = scan.index;
    entry.format = ScanFormat::kPcd;
    entry.given = entry.pose = scan.initial_pose;
    folder.odometry_.poses.push_back(scan.initial_pose);
  }
  folder.odometry_.stamps = stamps;
  folder.stamps_ = std::move(stamps);
  folder.pose_source_ = source;
  folder.num_registered_ = scans.size();
  folder.moved_ = moved;
  if (moved)
    folder.coordinates_ = "points far from their origin are read near the origin, "
                          "where the runs shifted them";
  return folder;
}

void
ScanFolder::replacePoses(const std::vector<Eigen::Isometry3d>& poses,
                         const std::string& source)
{
  require(poses.size() == entries_.size(), "poses", poses.size(), "one per scan");
  require(num_registered_ == 0, "registered scans", num_registered_, "none");
  for (const Eigen::Isometry3d& pose : poses)
    if (!isRigid(pose))
      throw BadArgument("a pose is not a rigid motion");
  for (std::size_t i = 0; i < poses.size(); ++i)
    entries_[i].pose = poses[i];
  if (odometry_.poses.size() == poses.size())
    odometry_.poses = poses;
  pose_source_ = source;
  are_estimated_ = true;
}

void
ScanFolder::keepOnly(const std::vector<std::size_t>& places)
{
  require(num_registered_ == 0, "registered scans", num_registered_, "none");
  require(!places.empty(), "scans", places.size(), "> 0");
  std::vector<Entry> kept;
  std::vector<double> stamps;
  for (std::size_t k = 0; k < places.size(); ++k) {
    require(places[k] < entries_.size() && (k == 0 || places[k] > places[k - 1]),
            "place",
            places[k],
            "increasing, and one of " + std::to_string(entries_.size()) + " scans");
    kept.push_back(entries_[places[k]]);
    if (!stamps_.empty())
      stamps.push_back(stamps_[places[k]]);
  }
  if (places.front() != 0)
    first_.reset(); // belongs to a removed scan
  entries_ = std::move(kept);
  stamps_ = std::move(stamps);
}

namespace {
/** The files of a run, of scans and of the sweeps between keyframes, and the index of the next
 * scan. */
struct FilesOfRun {
  explicit FilesOfRun(const RunResult& summary)
  {
    for (const auto& scan : summary.scans) {
      names.insert(scan.file);
      next_index = std::max(next_index, scan.index + 1);
    }
    if (!summary.drive)
      return;
    const std::vector<std::string>& sweeps = summary.drive->files;
    names.insert(sweeps.begin(), sweeps.end());
    next_index =
        std::max(next_index, summary.drive->first + static_cast<int>(sweeps.size()));
  }

  std::set<std::string> names;
  int next_index = 0;
};

/** \return [s] the stamps of the scans of a run; without stamps, the indices of the scans, if these
 * are the stamps of the folder, too; else empty
 * \param[in] stamps_of_folder by file name */
std::vector<double>
stampsToContinue(const fs::path& run,
                 const RunResult& summary,
                 const std::map<std::string, double>& stamps_of_folder)
{
  std::vector<double> stamps = stampsOfRun(run, summary);
  if (stamps.empty() && areNumbers(stamps_of_folder, summary))
    for (const auto& scan : summary.scans)
      stamps.push_back(scan.index);
  return stamps;
}
} // namespace

void
ScanFolder::continueRun(const fs::path& run, const RunResult& summary)
{
  std::vector<Entry> entries;
  for (const auto& scan : summary.scans) {
    const fs::path file = run / "scans" / (scanName(scan.index) + ".pcd");
    if (!fs::exists(file))
      text::fail(file,
                 "is missing, though " + (run / "summary.json").string() +
                     " lists the file");
    entries.push_back({file,
                       scan.file,
                       scan.index,
                       scan.initial_pose,
                       ScanFormat::kPcd,
                       false,
                       scan.initial_pose,
                       {},
                       0});
  }
  std::map<std::string, double> stamps_of_folder;
  for (std::size_t i = 0; i < stamps_.size(); ++i)
    stamps_of_folder[entries_[i].name] = stamps_[i];
  std::vector<double> stamps = stampsToContinue(run, summary, stamps_of_folder);
  FilesOfRun of_run(summary);
  for (std::size_t i = 0; i < entries_.size(); ++i)
    if (of_run.names.count(entries_[i].name) == 0) {
      entries.push_back(entries_[i]);
      entries.back().index = of_run.next_index++;
      if (!stamps.empty() && !stamps_.empty())
        stamps.push_back(stamps_[i]);
    }
  num_registered_ = summary.scans.size();
  if (entries.size() == num_registered_)
    text::fail(run,
               "holds all " + text::counted(entries_.size(), "scan") +
                   " of the folder already (scans are told apart by their file names)");
  if (stamps_.empty())
    stamps.clear();
  stamps_ = std::move(stamps);
  entries_ = std::move(entries);
  first_.reset();
  if (moved_ && summary.moved) { // the trajectory continues
    moved_ = summary.moved;
    placeNear();
  }
}

} // namespace pcl6d
