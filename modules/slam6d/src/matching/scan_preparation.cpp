// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/filters/planar_scan.h>
#include <pcl6d/filters/range_statistics.h>
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
/** \return the limits of the gate that the user may set, "" if both are given */
std::string
derivedLimits(const Slam6DParameters& p)
{
  if (!p.max_range.given && p.max_range.value < p.min_range.value)
    return ", the most for voxels of " + std::to_string(p.voxel.value) +
           " m can number (see voxel)";
  std::string names = p.min_range.given ? "" : "min range";
  if (!p.max_range.given)
    names += names.empty() ? "max range" : " and max range";
  return names.empty() ? "" : " (derived; see " + names + ")";
}
} // namespace

Points
gateScan(const Points& points, const std::string& name, const Slam6DParameters& p)
{
  Points kept = gateByRange(points, p.min_range.value, p.max_range.value);
  if (kept.size() < 3) {
    std::ostringstream gate;
    gate << "within the range gate of " << p.min_range.value << " to "
         << p.max_range.value << " m" << derivedLimits(p);
    throw ComputeFailed(tooFewPoints(name, kept.size(), gate.str()));
  }
  if (p.planar_rows.value > 0 && isPlanarScan(kept))
    return raisedPlanarScan(kept, p.planar_rows.value);
  return kept;
}

Points
reduceScan(const Points& gated,
           const std::string& name,
           const Slam6DParameters& p,
           ReductionOptions reduction)
{
  reduction.voxel = p.voxel.value;
  try {
    return reducePoints(gated, reduction);
  } catch (const BadArgument& e) {
    throw ComputeFailed(name + ": " + e.what() + " (see voxel" +
                        (p.voxel.given ? "" : ", derived,") + " and max range)");
  }
}

Points
prepareScan(const Points& points, const std::string& name, const Slam6DParameters& p)
{
  return reduceScan(gateScan(points, name, p), name, p);
}

} // namespace pcl6d
