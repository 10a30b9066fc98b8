// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "evidence_parts.h"

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
using namespace verification;

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

/** A rough match ends this near to an earlier pose, as share of the above: within the pair
 * distance, 1.7 voxels, where the surfaces of both are pairs already. */
constexpr double kCaught = 1.0 / 4;

/** Number of steps of a rough match: 5 while the pair distance shrinks, and until most starts rest. */
constexpr int kRoughSteps = 30;

/** The last steps of a match, as share of those of a rough match: 2e-3 voxels and 4e-4 rad, which
 * leaves less than the resolution of link tests (kResolution) at both ends of a scan. */
constexpr double kRest = 0.1;

/** A roughly matched pose is hopeless with less confirmed surface than this share of the known pose's:
 * half of what a second pose needs, for what the rough match leaves. */
constexpr double kLeastConfirmed = kTwinShare / 2;

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
  constexpr int kSide = 2 * kMostCells + 4; // shifts between any two cells, rounded
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

/** An even selection of the points of a scan, with their normals. */
struct Sample {
  Sample(const IcpModel& surfaces, std::size_t count)
  {
    const std::size_t stride =
        std::max<std::size_t>(1, surfaces.points().size() / count);
    for (std::size_t i = stride / 2; i < surfaces.points().size(); i += stride) {
      points.push_back(surfaces.points()[i]);
      normals.push_back(surfaces.normals()[i]);
    }
  }

  Points points;
  Normals normals;
};

/** Matches starts by as many points as link tests use: each roughly, and on to rest if the rough match
 * may be a second pose. */
class TwinMatcher {
public:
  TwinMatcher(const VerifiedScan& first,
              const VerifiedScan& second,
              const Eigen::Isometry3d& T_first_second)
  : first_(first)
  , second_(second)
  , voxel_(std::max(first.voxel(), second.voxel()))
  , sample_(second.surfaces(), kPairedPoints)
  , known_(T_first_second)
  , confirmed_(static_cast<double>(sightAt(known_).confirmed_patches))
  {}

  void
  tryFrom(const Eigen::Isometry3d& start)
  {
    const auto rough = roughMatch(start);
    if (!rough)
      return;
    const IcpResult found =
        icp({first_.surfaces().part()}, sampleSource(), *rough, matchOptions());
    if (found.stop == IcpStop::kAtRest && !isAtPlace(found.T_target_source, 1))
      twins_.push_back(found.T_target_source);
  }

  const std::vector<Eigen::Isometry3d>&
  twins() const
  {
    return twins_;
  }

private:
  IcpSource
  sampleSource() const
  {
    return {&sample_.points, &sample_.normals};
  }

  IcpOptions
  matchOptions() const
  {
    IcpOptions options; // equal to Slam6D's
    options.metric = Metric::kGicp;
    options.gicp_epsilon = kReducedGicpEpsilon;
    options.facing_normals = true;
    options.max_distance = kPlanePairVoxels * voxel_;
    options.translation_epsilon = kRest * kSettled * voxel_;
    options.rotation_epsilon = kRest * kSettled * kOtherTurn;
    options.num_threads = 1;
    return options;
  }

  /** \return whether a pose is near the known pose or a found one
   * \param[in] share of the distance and the turn below which poses are equal */
  bool
  isAtPlace(const Eigen::Isometry3d& pose, double share) const
  {
    const auto isNear = [&](const Eigen::Isometry3d& other) {
      const MotionSize apart = distanceBetween(other, pose);
      return apart.translation < share * kOtherVoxels * voxel_ &&
             apart.rotation < share * kOtherTurn;
    };
    return isNear(known_) || std::any_of(twins_.begin(), twins_.end(), isNear);
  }

  SightEvidence
  sightAt(const Eigen::Isometry3d& pose) const
  {
    const SurfaceFit fit =
        settledFit(first_, second_, pose, voxel_, kProbedPoints, kProbedSteps, false);
    return sightBothWays(first_, second_, pose, voxel_, fit);
  }

  /** \return whether rays contradict a pose however often right links are contradicted, or confirm
   * too little surface */
  bool
  isHopeless(const Eigen::Isometry3d& pose) const
  {
    const SightEvidence sight = sightAt(pose);
    const RaysAgainst against =
        raysAgainst(sight.contradicted_patches,
                    sight.patches,
                    {kMostBackground, kLeastBackground, kBackgroundPrecision});
    return probabilityOf(against, kEvenShare) > kWrongAbove ||
           static_cast<double>(sight.confirmed_patches) < kLeastConfirmed * confirmed_;
  }

  /** \return the roughly matched pose; none: it leads to the known or a found pose, or is
   * hopeless */
  std::optional<Eigen::Isometry3d>
  roughMatch(const Eigen::Isometry3d& start) const
  {
    IcpOptions options = matchOptions();
    options.max_distance_start = kOtherVoxels * voxel_;
    options.distance_decay = 0.75;
    options.max_iterations = kRoughSteps;
    options.translation_epsilon = kSettled * voxel_;
    options.rotation_epsilon = kSettled * kOtherTurn;
    IcpHooks hooks;
    hooks.observer = [&](const IcpIteration& now) {
      return now.max_distance > options.max_distance ||
             !isAtPlace(now.T_target_source, kCaught);
    };
    const IcpResult found =
        icp({first_.surfaces().part()}, sampleSource(), start, options, hooks);
    if (found.stop == IcpStop::kTooFewPairs || found.stop == IcpStop::kDiverged ||
        isAtPlace(found.T_target_source, 1) || isHopeless(found.T_target_source))
      return std::nullopt;
    return found.T_target_source;
  }

  const VerifiedScan& first_;
  const VerifiedScan& second_;
  double voxel_;
  Sample sample_; ///< of the second scan
  Eigen::Isometry3d known_;
  double confirmed_; ///< patches at the known pose
  std::vector<Eigen::Isometry3d> twins_;
};
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
  const auto level = shortestRotation(up, Eigen::Vector3d::UnitZ());
  TwinMatcher matcher(first, second, T_first_second);
  for (const auto& start : votedStarts(first, second, level, T_first_second))
    matcher.tryFrom(level.inverse() * start);
  return matcher.twins();
}

} // namespace pcl6d
