// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/pose.h>
#include <pcl6d/registration/icp.h>
#include <pcl6d/verification/twin_search.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace pcl6d {

namespace {
/** A plan has cells of so many voxels, and no more than so many of them along a side, so
 * that few enough pairs of cells vote. */
constexpr double kCellVoxels = 3;
constexpr int kMostCells = 128;

/** Surfaces are upright whose normals are so near the level: cosine of 60 deg. */
constexpr double kLevelNormal = 0.5;

/** So many cells of a plan vote: more tell nothing new. */
constexpr std::size_t kVoters = 1200;

/** So many shifts of each quarter turn are matched. */
constexpr std::size_t kShiftsTried = 4;

/** A place is another one if it is farther away than so many voxels, or turned by more. */
constexpr double kOtherVoxels = 6, kOtherTurn = 0.2; // [rad]

/** The cells of a plan that upright surfaces fill, in the order of their filling. */
using Plan = std::vector<Eigen::Vector2i>;

Plan
planOf(const VerifiedScan& scan, const Eigen::Isometry3d& T_level_scan, double cell)
{
  std::vector<std::pair<int, int>> cells;
  const Points& points = scan.surfaces().points();
  const Normals& normals = scan.surfaces().normals();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d n = T_level_scan.linear() * normals[i].cast<double>();
    if (normals[i].isZero(0) || std::abs(n.z()) > kLevelNormal)
      continue;
    const Eigen::Vector3d p = T_level_scan * points[i].cast<double>() / cell;
    cells.emplace_back(static_cast<int>(std::floor(p.x())),
                       static_cast<int>(std::floor(p.y())));
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  const std::size_t stride = std::max<std::size_t>(1, cells.size() / kVoters);
  Plan plan;
  for (std::size_t i = 0; i < cells.size(); i += stride)
    plan.emplace_back(cells[i].first, cells[i].second);
  return plan;
}

/** \return [m] a cell so that the points of a scan fill no more than the most */
double
cellFor(const VerifiedScan& scan)
{
  double reach = 0;
  for (const auto& p : scan.surfaces().points())
    reach = std::max(reach, static_cast<double>(p.norm()));
  return std::max(kCellVoxels * scan.voxel(), 2 * reach / kMostCells);
}

/** \return the shifts [cells] that most pairs of cells vote for, each a few cells from the
 * others, the best first */
std::vector<Eigen::Vector2i>
votedShifts(const Plan& fixed, const Plan& moved)
{
  constexpr int kSide = 4 * kMostCells;
  std::vector<std::uint32_t> votes(static_cast<std::size_t>(kSide) * kSide, 0);
  const auto at = [](const Eigen::Vector2i& shift) {
    return static_cast<std::size_t>((shift.y() + kSide / 2) * kSide + shift.x() +
                                    kSide / 2);
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

/** \return the place that matching finds from a start, if it comes to rest */
std::vector<Eigen::Isometry3d>
matchedFrom(const VerifiedScan& first,
            const VerifiedScan& second,
            const Eigen::Isometry3d& start)
{
  const double voxel = std::max(first.voxel(), second.voxel());
  IcpOptions options; // as Slam6D matches
  options.metric = Metric::kGicp;
  options.gicp_epsilon = 0.01;
  options.facing_normals = true;
  options.max_distance = 1.7 * voxel;
  options.max_distance_start = 6 * voxel;
  options.distance_decay = 0.75;
  options.shrinking_stride = 3;
  options.num_threads = 1;
  const IcpResult found =
      icp({first.surfaces().part()}, second.surfaces().source(), start, options);
  if (found.stop != IcpStop::kAtRest)
    return {};
  return {found.T_target_source};
}
} // namespace

std::vector<Eigen::Isometry3d>
findTwins(const VerifiedScan& first,
          const VerifiedScan& second,
          const Eigen::Isometry3d& T_first_second,
          const Eigen::Vector3d& up)
{
  constexpr double kQuarter = 1.5707963267948966;
  const double voxel = std::max(first.voxel(), second.voxel());
  const double cell = std::max(cellFor(first), cellFor(second));
  Eigen::Isometry3d T_level_first = Eigen::Isometry3d::Identity();
  T_level_first.linear() =
      Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ())
          .toRotationMatrix();
  const Plan fixed = planOf(first, T_level_first, cell);
  std::vector<Eigen::Isometry3d> twins;
  for (int quarter = 0; quarter < 4; ++quarter) {
    Eigen::Isometry3d T_level_second = T_level_first * T_first_second;
    const Eigen::Vector3d pivot = T_level_second.translation();
    T_level_second = Eigen::Translation3d(pivot) *
                     Eigen::AngleAxisd(quarter * kQuarter, Eigen::Vector3d::UnitZ()) *
                     Eigen::Translation3d(-pivot) * T_level_second;
    for (const Eigen::Vector2i& shift :
         votedShifts(fixed, planOf(second, T_level_second, cell))) {
      Eigen::Isometry3d start = T_level_second;
      start.pretranslate(Eigen::Vector3d(shift.x() * cell, shift.y() * cell, 0));
      for (const Eigen::Isometry3d& T :
           matchedFrom(first, second, T_level_first.inverse() * start)) {
        const auto isNear = [&](const Eigen::Isometry3d& other) {
          const MotionSize apart = distanceBetween(other, T);
          return apart.translation < kOtherVoxels * voxel &&
                 apart.rotation < kOtherTurn;
        };
        if (!isNear(T_first_second) && std::none_of(twins.begin(), twins.end(), isNear))
          twins.push_back(T);
      }
    }
  }
  return twins;
}

} // namespace pcl6d
