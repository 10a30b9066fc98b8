// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/filters/voxel_reduction.h>
#include <pcl6d/slam6d/scan_preparation.h>

#include <algorithm>
#include <sstream>

namespace pcl6d {

std::size_t
countFinite(const Points& points)
{
  return std::count_if(
      points.begin(), points.end(), [](const auto& p) { return p.allFinite(); });
}

std::string
tooFewPoints(const std::string& scan, std::size_t count, const std::string& where)
{
  return scan + ": " + std::to_string(count) + " points " + where +
         ", but at least 3 are needed";
}

namespace {
/** \return which limits of the gate the user may want to give, "" if both are given */
std::string
derivedLimits(const Slam6DParameters& p)
{
  std::string names = p.min_range.given ? "" : "min_range";
  if (!p.max_range.given)
    names += names.empty() ? "max_range" : " and max_range";
  return names.empty() ? "" : " (derived; see " + names + ")";
}
} // namespace

Points
prepareScan(const Points& points, const std::string& name, const Slam6DParameters& p)
{
  const Points kept = gateByRange(points, p.min_range.value, p.max_range.value);
  if (kept.size() < 3) {
    std::ostringstream gate;
    gate << "within the range gate of " << p.min_range.value << " to "
         << p.max_range.value << " m" << derivedLimits(p);
    throw ComputeFailed(tooFewPoints(name, kept.size(), gate.str()));
  }
  ReductionOptions reduction;
  reduction.voxel = p.voxel.value;
  try {
    return reducePoints(kept, reduction);
  } catch (const BadArgument& e) {
    throw ComputeFailed(name + ": " + e.what() + " (see voxel" +
                        (p.voxel.given ? "" : ", derived,") + " and max_range)");
  }
}
} // namespace pcl6d
