// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/number_range.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/registration/icp.h>
#include <pcl6d/registration/reduced_scans.h>
#include <pcl6d/verification/twin_search.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace pcl6d {

namespace {
/** [voxels] Size of the cells of a plan; larger if a side would have too many cells, to limit the
 * number of voting pairs. */
constexpr double kCellVoxels = 3;
constexpr int kMostCells = 128;

/** A surface is upright if its normal is nearly level: cosine of 60 deg. */
constexpr double kLevelNormal = 0.5;

/** Number of cells of a plan that vote: more cells add no information. */
constexpr std::size_t kVoters = 1200;

/** Number of matched shifts of each quarter turn. */
constexpr std::size_t kShiftsTried = 4;

/** Poses closer than this distance and turn are equal. */
constexpr double kOtherVoxels = 6, kOtherTurn = 0.2; // [rad]

/** Tolerance of the length of unit vectors: for the rotation of a rigid pose. */
constexpr double kUnitLength = 2e-3;

/** The cells of a plan filled by upright surfaces, in the order of their filling. */
using Plan = std::vector<Eigen::Vector2i>;

/** The plan about the scan's own origin, whatever the pose of the scan.
 * \param[in] cell [m] from cellFor() */
Plan
planOf(const VerifiedScan& scan, const Eigen::Matrix3d& R_level_scan, double cell)
{
  std::vector<std::pair<int, int>> cells;
  const Points& points = scan.surfaces().points();
  const Normals& normals = scan.surfaces().normals();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d n = R_level_scan * normals[i].cast<double>();
    if (normals[i].isZero(0) || std::abs(n.z()) > kLevelNormal)
      continue;
    const Eigen::Vector3d p = R_level_scan * points[i].cast<double>() / cell;
    cells.emplace_back(clampedTo<int>(std::floor(p.x())),
                       clampedTo<int>(std::floor(p.y())));
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  const std::size_t stride = std::max<std::size_t>(1, cells.size() / kVoters);
  Plan plan;
  for (std::size_t i = 0; i < cells.size(); i += stride)
    plan.emplace_back(cells[i].first, cells[i].second);
  return plan;
}

/** \return [m] a cell size with all points of a scan within half the most cells */
double
cellFor(const VerifiedScan& scan)
{
  double reach = 0;
  for (const auto& p : scan.surfaces().points())
    reach = std::max(reach, p.cast<double>().norm());
  return std::max(kCellVoxels * scan.voxel(), 2 * reach / kMostCells);
}

/** \return the shifts [cells] with the most votes of pairs of cells, the best first, each a few
 * cells apart from the rest */
std::vector<Eigen::Vector2i>
votedShifts(const Plan& fixed, const Plan& moved)
{
  constexpr int kSide = 4 * kMostCells;
  std::vector<std::uint32_t> votes(static_cast<std::size_t>(kSide) * kSide, 0);
  const auto at = [](const Eigen::Vector2i& shift) {
    const int cell = (shift.y() + kSide / 2) * kSide + shift.x() + kSide / 2;
    return static_cast<std::size_t>(cell);
  };
  for (const auto& f : fixed)
    for (const auto& m : moved) {
      const Eigen::Vector2i shift = f - m;
      if (shift.cwiseAbs().maxCoeff() < kSide / 2)
        ++votes[at(shift)];
    }
  constexpr int kApart = 4; // cells
  std::vector<Eigen::Vector2i> best;
  while (best.size() < kShiftsTried) {
    const auto most = std::max_element(votes.begin(), votes.end());
    if (*most == 0)
      break;
    const auto place = static_cast<int>(most - votes.begin());
    const Eigen::Vector2i shift(place % kSide - kSide / 2, place / kSide - kSide / 2);
    best.push_back(shift);
    for (int y = -kApart; y <= kApart; ++y)
      for (int x = -kApart; x <= kApart; ++x) {
        const Eigen::Vector2i near = shift + Eigen::Vector2i(x, y);
        if (near.cwiseAbs().maxCoeff() < kSide / 2)
          votes[at(near)] = 0;
      }
  }
  return best;
}

/** \return start poses of the second scan for matching, in the frame of the first scan turned
 * upright: ordered by quarter turn, then by falling number of votes */
std::vector<Eigen::Isometry3d>
votedStarts(const VerifiedScan& first,
            const VerifiedScan& second,
            const Eigen::Quaterniond& level,
            const Eigen::Isometry3d& T_first_second)
{
  constexpr double kCosines[] = {1, 0, -1, 0}; // of quarter turns
  const double cell = std::max(cellFor(first), cellFor(second));
  const Plan fixed = planOf(first, level.toRotationMatrix(), cell);
  const Eigen::Isometry3d T_level_second = level * T_first_second;
  std::vector<Eigen::Isometry3d> starts;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double c = kCosines[quarter], sine = kCosines[(quarter + 3) % 4];
    Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
    turn.linear() << c, -sine, 0, sine, c, 0, 0, 0, 1;
    Eigen::Isometry3d start = turn * T_level_second;
    for (const auto& shift : votedShifts(fixed, planOf(second, start.linear(), cell))) {
      start.translation() << shift.cast<double>() * cell,
          T_level_second.translation().z();
      starts.push_back(start);
    }
  }
  return starts;
}

/** \return the matched pose from a start, if converged */
std::optional<Eigen::Isometry3d>
matchedFrom(const VerifiedScan& first,
            const VerifiedScan& second,
            const Eigen::Isometry3d& start)
{
  const double voxel = std::max(first.voxel(), second.voxel());
  IcpOptions options; // equal to Slam6D's
  options.metric = Metric::kGicp;
  options.gicp_epsilon = kReducedGicpEpsilon;
  options.facing_normals = true;
  options.max_distance = kPlanePairVoxels * voxel;
  options.max_distance_start = 6 * voxel;
  options.distance_decay = 0.75;
  options.shrinking_stride = 3;
  options.num_threads = 1;
  const IcpResult found =
      icp({first.surfaces().part()}, second.surfaces().source(), start, options);
  if (found.stop != IcpStop::kAtRest)
    return std::nullopt;
  return found.T_target_source;
}
} // namespace

std::vector<Eigen::Isometry3d>
findTwins(const VerifiedScan& first,
          const VerifiedScan& second,
          const Eigen::Isometry3d& T_first_second,
          const Eigen::Vector3d& up)
{
  if (!isRigid(T_first_second))
    throw BadArgument("T_first_second is not a rigid motion");
  require(std::abs(up.norm() - 1) < kUnitLength, "up", up.transpose(), "a unit vector");
  const double voxel = std::max(first.voxel(), second.voxel());
  const auto level = shortestRotation(up, Eigen::Vector3d::UnitZ());
  std::vector<Eigen::Isometry3d> twins;
  for (const auto& start : votedStarts(first, second, level, T_first_second)) {
    const auto place = matchedFrom(first, second, level.inverse() * start);
    const auto isNear = [&](const Eigen::Isometry3d& other) {
      const MotionSize apart = distanceBetween(other, *place);
      return apart.translation < kOtherVoxels * voxel && apart.rotation < kOtherTurn;
    };
    if (place && !isNear(T_first_second) &&
        std::none_of(twins.begin(), twins.end(), isNear))
      twins.push_back(*place);
  }
  return twins;
}

} // namespace pcl6d
