// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/run_scans.h"

#include <pcl6d/common/error.h>

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

/** \return what the call returns; a rule that the data break is told with the file's
 * name */
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
} // namespace

void
RunScans::deskew(MotionInterpolation interpolation)
{
  const std::size_t first = folder_.numRegistered();
  const std::string file = folder_.file(first).string();
  const std::string name = folder_.file(first).parent_path().string();
  if (!folder_.hasPoses())
    throw IoFailed(name + ": --deskew needs the motion of the scanner, but no poses "
                          "were found");
  if (folder_.stamps().empty())
    throw IoFailed(name +
                   ": --deskew needs the time stamps of the scans, but there is "
                   "no times.txt, and the poses (" +
                   folder_.poseSource() + ") are no TUM rows");
  correction_ = withName(
      name, [&] { return MotionCorrection(folder_.odometry(), interpolation); });
  first_ = folder_.read(first);
  const FieldValues times = timesOf(*first_, first);
  format_ = withName(
      file, [&] { return correction_->timeFormat(times, folder_.stamps()[first]); });
  description_ = "motion during a scan is corrected: field " + times.name + ", " +
                 toString(format_);
}

FieldValues
RunScans::timesOf(const Scan& scan, std::size_t i) const
{
  const std::string file = folder_.file(i).string();
  auto times = withName(file, [&] { return timeField(scan.cloud); });
  if (!times)
    throw IoFailed(file + ": has no field t or time, which --deskew needs (fields: " +
                   fieldNames(scan.cloud) + ")");
  return *std::move(times);
}

Scan
RunScans::read(std::size_t i)
{
  Scan scan = first_ && i == folder_.numRegistered() ? *std::exchange(first_, {})
                                                     : folder_.read(i);
  if (!correction_ || i < folder_.numRegistered())
    return scan;
  withName(folder_.file(i).string(), [&] {
    const double stamp = folder_.stamps()[i];
    correction_->correct(
        scan.points, correction_->timesOf(timesOf(scan, i), format_, stamp), stamp);
    storeCoordinates(scan.points, scan.cloud);
  });
  return scan;
}

} // namespace pcl6d::app
