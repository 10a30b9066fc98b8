// SPDX-License-Identifier: BSD-3-Clause
#include "scan/stamps_of_scans.h"

#include <pcl6d/common/median.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/text.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl6d::io {

namespace {
/** [s] since 1970: stamps in names are later (stampsOfNames()). */
constexpr double kLeastTimeOfNames = 1e9;

/** \return [s] half of the median step; 0 for fewer than two stamps */
double
halfStepOf(const std::vector<double>& stamps)
{
  std::vector<double> steps;
  for (std::size_t i = 1; i < stamps.size(); ++i)
    steps.push_back(stamps[i] - stamps[i - 1]);
  return steps.empty() ? 0 : upperMedian(std::move(steps)) / 2;
}

/** \return the index of the stamp nearest to a time */
std::size_t
nearestTo(double time, const std::vector<double>& stamps)
{
  const auto after = std::lower_bound(stamps.begin(), stamps.end(), time);
  const auto i = static_cast<std::size_t>(after - stamps.begin());
  if (i == 0)
    return 0;
  return i == stamps.size() || time - stamps[i - 1] <= stamps[i] - time ? i - 1 : i;
}
} // namespace

std::optional<Trajectory>
posesAtStamps(const Trajectory& trajectory, const std::vector<double>& stamps)
{
  if (stamps.empty() || trajectory.stamps.empty())
    return std::nullopt;
  double tolerance = halfStepOf(trajectory.stamps);
  if (stamps.size() > 1)
    tolerance = std::min(tolerance, halfStepOf(stamps));
  Trajectory of_scans;
  for (const double stamp : stamps) {
    const std::size_t i = nearestTo(stamp, trajectory.stamps);
    if (!(std::abs(trajectory.stamps[i] - stamp) <= tolerance) ||
        (!of_scans.stamps.empty() && of_scans.stamps.back() == trajectory.stamps[i]))
      return std::nullopt;
    of_scans.poses.push_back(trajectory.poses[i]);
    of_scans.stamps.push_back(trajectory.stamps[i]);
  }
  return of_scans;
}

std::string
contradictionOfStamps(const std::vector<double>& stamps,
                      const std::string& source,
                      const std::vector<std::filesystem::path>& scans)
{
  if (stamps.size() != scans.size())
    return "";
  const std::vector<double> names = stampsOfNames(scans);
  if (names.empty())
    return "";
  const bool is_same_clock = stamps.front() >= kLeastTimeOfNames;
  const double shift = is_same_clock ? 0 : names.front() - stamps.front();
  const double tolerance = halfStepOf(names);
  for (std::size_t i = 0; i < names.size(); ++i)
    if (std::abs(stamps[i] + shift - names[i]) > tolerance)
      return "the stamps of " + source +
             " contradict the names of the scans: " + scans[i].filename().string() +
             " has the stamp " + text::shortest(stamps[i]) +
             "; the order of the names is used";
  return "";
}

} // namespace pcl6d::io
