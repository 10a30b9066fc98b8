// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/input/run_scans.h"

#include <pcl6d/common/error.h>
#include <pcl6d/deskew/motion_icp.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/io/text.h>

#include <algorithm>
#include <utility>

namespace pcl6d::app {

namespace {
std::string
fieldNames(const pcl::PCLPointCloud2& cloud)
{
  std::string names;
  for (const auto& field : cloud.fields)
    names += (names.empty() ? "" : " ") + field.name;
  return names;
}

/** \return the result of the call; BadArgument becomes IoFailed with the file's name */
template <typename Call>
auto
withName(const std::string& name, Call&& call)
{
  try {
    return call();
  } catch (const BadArgument& e) {
    throw IoFailed(name + ": " + e.what());
  }
}
/** \return the folder or file of all scans \param[in] i any of the scans */
std::string
nameOfAll(const ScanFolder& folder, std::size_t i)
{
  const auto& file = folder.file(i);
  return (folder.sharesFile(i) ? file : file.parent_path()).string();
}
} // namespace

void
RunScans::deskew(MotionInterpolation interpolation, std::vector<Trajectory> paths)
{
  paths_ = std::move(paths);
  const std::size_t first = folder_.numRegistered();
  const std::string file = folder_.title(first);
  const std::string name = nameOfAll(folder_, first);
  if (!folder_.hasPoses())
    throw IoFailed(name + ": --deskew needs the motion of the scanner, but no poses "
                          "were found");
  if (folder_.stamps().empty())
    throw IoFailed(name +
                   ": --deskew needs the time stamps of the scans, but times.txt is "
                   "missing, and the poses (" +
                   folder_.poseSource() + ") are no TUM rows");
  correction_ = withName(
      name, [&] { return MotionCorrection(folder_.odometry(), interpolation); });
  first_ = folder_.read(first);
  const FieldValues times = timesOf(first_->cloud, first);
  format_ = withName(
      file, [&] { return correction_->timeFormat(times, folder_.stamps()[first]); });
  descriptions_.push_back("motion during a scan is corrected: field " + times.name +
                          ", " + toString(format_));
}

/** The unit of times is derived from stamps; without stamps, from the times alone. */
void
RunScans::estimateMotion()
{
  const std::size_t first = folder_.numRegistered();
  const auto& stamps = folder_.stamps();
  if (stamps.size() > 1) {
    Trajectory clock;
    clock.stamps = stamps;
    clock.poses.assign(stamps.size(), Eigen::Isometry3d::Identity());
    clock_ =
        withName(nameOfAll(folder_, first), [&] { return MotionCorrection(clock); });
  }
  first_ = folder_.read(first);
  const FieldValues times = timesOf(first_->cloud, first);
  format_ = withName(folder_.title(first), [&] {
    return clock_ ? clock_->timeFormat(times, stamps[first]) : timeFormatAlone(times);
  });
  estimates_motion_ = true;
  descriptions_.push_back("motion during a scan is found from the scans: field " +
                          times.name + ", " + toString(format_));
}

ScanTimes
RunScans::scanTimes(const pcl::PCLPointCloud2& cloud, std::size_t i) const
{
  const FieldValues field = timesOf(cloud, i);
  const auto& stamps = folder_.stamps();
  ScanTimes times;
  if (!stamps.empty())
    times.stamp = stamps[i];
  if (clock_) {
    times.times = withName(folder_.title(i),
                           [&] { return clock_->timesOf(field, format_, stamps[i]); });
    return times;
  }
  withName(folder_.title(i), [&] { return timeFormatAlone(field); });
  for (const double value : field.values)
    times.times.push_back(value * format_.unit);
  if (format_.is_absolute && !times.times.empty()) {
    const double begin = *std::min_element(times.times.begin(), times.times.end());
    times.stamp = times.stamp.value_or(begin);
    for (double& time : times.times)
      time -= *times.stamp;
  }
  return times;
}

ScanTimes
RunScans::scanTimes(const Scan& scan, std::size_t i) const
{
  return scanTimes(scan.cloud, i);
}

void
RunScans::undoMotion(const MotionWithinScan& motion,
                     std::size_t i,
                     pcl::PCLPointCloud2& cloud) const
{
  if (!motion.deskewed || motion.path.poses.empty()) // or deskewed by an earlier run
    return;
  TimedPoints scan{coordinatesOf(cloud), scanTimes(cloud, i).times};
  storeCoordinates(pcl6d::undoMotion(scan, motion.path, 0, 1), cloud);
}

void
RunScans::filterLines(LineFilter filter)
{
  filter_ = filter;
  const bool median = filter == LineFilter::kMedian || filter == LineFilter::kBoth;
  if (median)
    descriptions_.push_back("mixed pixels are moved to the median range of " +
                            std::to_string(ScanLineMedianOptions().window) +
                            " values on their line");
  if (filter != LineFilter::kNone && filter != LineFilter::kMedian)
    descriptions_.push_back("points closer than " +
                            text::shortest(ScanLineReductionOptions().max_distance) +
                            " m on a line are merged");
}

void
RunScans::filterBy(const OtherFilter& filter)
{
  other_filter_ = filter;
  if (filter.filter)
    descriptions_.push_back("scans go through the filter " + filter.name);
}

void
RunScans::gate(std::vector<std::pair<double, double>> gates)
{
  gates_ = std::move(gates);
  if (!gates_.empty())
    descriptions_.push_back(
        "points outside the range gate of their own run are left out");
}

void
RunScans::gateRegistered(Scan& scan, std::size_t i) const
{
  if (gates_.empty())
    return;
  const std::size_t dropped = scan.dropped;
  maskOutOfRange(gates_[i].first, gates_[i].second, scan.points);
  storeCoordinates(scan.points, scan.cloud);
  static_cast<ScanCloud&>(scan) = finiteScan(scan.cloud, folder_.title(i));
  scan.dropped += dropped;
  scan.points = coordinatesOf(scan.cloud);
}

/** Counts the non-finite points of the file and of the filter. */
void
RunScans::filterByOther(Scan& scan, std::size_t i) const
{
  const std::size_t dropped = scan.dropped;
  const std::string file = folder_.title(i);
  try {
    static_cast<ScanCloud&>(scan) = finiteScan(other_filter_.filter(scan.cloud), file);
  } catch (const ComputeFailed& e) {
    throw IoFailed(file + ": " + e.what());
  }
  scan.dropped += dropped;
  scan.points = coordinatesOf(scan.cloud);
}

void
RunScans::requireLines(const Scan& scan, std::size_t i) const
{
  if (scan.row_length == 0)
    throw IoFailed(
        folder_.title(i) + ": --filter " + toString(filter_) +
        " needs scan lines, but the points form a plain list; give organized PCD files "
        "(HEIGHT > 1, a scan line per row), or --filter none");
}

FieldValues
RunScans::timesOf(const pcl::PCLPointCloud2& cloud, std::size_t i) const
{
  const std::string file = folder_.title(i);
  auto times = withName(file, [&] { return timeField(cloud); });
  if (!times)
    throw IoFailed(file + ": has no field t or time for --deskew (fields: " +
                   fieldNames(cloud) + ")");
  return *std::move(times);
}

Scan
RunScans::read(std::size_t i)
{
  Scan scan = first_ && i == folder_.numRegistered() ? *std::exchange(first_, {})
                                                     : folder_.read(i);
  if (i < folder_.numRegistered()) {
    gateRegistered(scan, i);
    return scan;
  }
  if (filter_ != LineFilter::kNone)
    requireLines(scan, i);
  withName(folder_.title(i), [&] {
    // The median compares ranges as measured; merging needs the final positions of points.
    if (filter_ == LineFilter::kMedian || filter_ == LineFilter::kBoth)
      filterByMedian(scan);
    if (correction_)
      undoMotion(scan, i);
    if (filter_ == LineFilter::kReduction || filter_ == LineFilter::kBoth)
      reduceLines(scan);
  });
  if (other_filter_.filter)
    filterByOther(scan, i);
  return scan;
}

void
RunScans::undoMotion(Scan& scan, std::size_t i) const
{
  const double stamp = folder_.stamps()[i];
  const std::vector<double> times =
      correction_->timesOf(timesOf(scan.cloud, i), format_, stamp);
  if (i < paths_.size() && !paths_[i].poses.empty())
    MotionCorrection(paths_[i]).correct(scan.points, times, 0);
  else
    correction_->correct(scan.points, times, stamp);
  storeCoordinates(scan.points, scan.cloud);
}

} // namespace pcl6d::app
