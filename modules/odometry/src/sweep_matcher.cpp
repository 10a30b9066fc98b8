// SPDX-License-Identifier: BSD-3-Clause
#include "sweep_equations.h"
#include "sweep_matcher.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/median.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/registration/localizability.h>
#include <pcl6d/registration/plane_sums.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace pcl6d::odometry {

namespace {

constexpr std::size_t kPointsPerBlock = 512;

/** Of a normal distribution: standard deviation over median of absolute values. */
constexpr double kOfMedian = 1.4826;

/** The kernel's final scale, in deviations: 99.7 % of a normal distribution. */
constexpr double kKernelDeviations = 3;

/** The scale of the kernel shrinks by this factor per iteration (MotionIcpOptions). */
constexpr double kDecay = 0.6;

/** Least points on surfaces: twice the number of unknowns. */
constexpr std::size_t kLeastPairs = 24;

/** [m, rad] A match ends when begin and end move less than this share of the noise. */
constexpr double kEndShare = 0.05;

/** A point, the surface at its position, and the distance. */
struct Pair {
  std::optional<VoxelKey> voxel; ///< the smallest around the point
  const MapSurface* surface = nullptr;
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();    ///< [m] from the centre
  Eigen::Vector3d offset = Eigen::Vector3d::Zero(); ///< [m] from the surface
  double deviation = 1;                             ///< [m] expected of the distance
  double distance = 0;                              ///< [m] signed for a plane

  double
  normalised() const
  {
    return std::abs(distance) / deviation;
  }

  /** \return whether the point lies on a plane of the map \param[in] usual of normalised() */
  bool
  isOnPlane(double usual) const
  {
    return surface && surface->shape == VoxelShape::kPlane &&
           normalised() <= kKernelDeviations * std::max(1.0, usual);
  }
};

/** State of the iterations of a match. */
class Match {
public:
  Match(const LocalMap& map,
        const SweepPoints& points,
        const SweepPrior& prior,
        const SweepMatchOptions& options)
  : map_(map)
  , points_(points)
  , prior_(prior)
  , options_(options)
  , num_parts_(prior.uneven ? kSweepParts : 1)
  , pairs_(points.size())
  {}

  SweepMatch
  run()
  {
    SweepMatch match;
    match.motion = prior_.uneven.value_or(prior_.motion);
    double scale = options_.gate;
    bool is_at_rest = false;
    while (match.iterations < options_.max_iterations) {
      ++match.iterations;
      findPairs(match.motion);
      if (!measureDeviation(match))
        return match;
      const Eigen::VectorXd step = solve(match, scale);
      if (!step.allFinite()) {
        match.status = Status::kDiverged;
        return match;
      }
      move(step, match.motion);
      scale *= kDecay;
      is_at_rest = scale < kKernelDeviations * options_.noise &&
                   movedBy(step) < kEndShare * options_.noise;
      if (is_at_rest)
        break;
    }
    match.status = is_at_rest ? Status::kOk : Status::kMaxIterations;
    describe(match);
    return match;
  }

private:
  void
  findPairs(const SweepMotion& motion)
  {
    parallelBlocks(
        points_.size(), kPointsPerBlock, options_.num_threads, [&](const Block& block) {
          for (std::size_t i = block.begin; i < block.end; ++i)
            pair(motion.place(points_[i]), pairs_[i]);
        });
  }

  /** Most points stay in their voxel from one iteration to the next. */
  void
  pair(const Eigen::Vector3d& place, Pair& pair) const
  {
    const std::optional<VoxelKey> voxel = map_.voxelAt(place);
    if (voxel != pair.voxel) {
      pair.voxel = voxel;
      pair.surface = voxel ? map_.surfaceIn(*voxel) : nullptr;
    }
    if (!pair.surface)
      return;
    pair.arm = place - prior_.centre;
    pair.offset = place - pair.surface->mean;
    pair.deviation =
        std::sqrt(pair.surface->variance + options_.noise * options_.noise);
    pair.distance = pair.surface->shape == VoxelShape::kPlane
                        ? pair.surface->normal.dot(pair.offset)
                        : pair.offset.norm() / std::sqrt(3.0);
  }

  /** \return whether the pairs suffice */
  bool
  measureDeviation(SweepMatch& match)
  {
    std::vector<double> normalised;
    normalised.reserve(pairs_.size());
    double arms_sq = 0;
    for (const Pair& pair : pairs_)
      if (pair.surface) {
        arms_sq += pair.arm.squaredNorm();
        if (pair.surface->shape == VoxelShape::kPlane)
          normalised.push_back(pair.normalised());
      }
    if (normalised.size() < kLeastPairs)
      return false;
    reach_ = std::sqrt(arms_sq / static_cast<double>(normalised.size()));
    match.deviation = std::max(kOfMedian * upperMedian(std::move(normalised)), 1e-3);
    return true;
  }

  /** \return [m] largest movement of the typical point */
  double
  movedBy(const Eigen::VectorXd& step) const
  {
    double translation = 0, rotation = 0;
    for (Eigen::Index at = 0; at < step.size(); at += 6) {
      translation = std::max(translation, step.segment<3>(at).norm());
      rotation = std::max(rotation, step.segment<3>(at + 3).norm());
    }
    return translation + reach_ * rotation;
  }

  std::vector<PartSums>
  sumsOf(const Block& block, double deviation, double scale) const
  {
    std::vector<PartSums> sums(num_parts_);
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const Pair& pair = pairs_[i];
      if (!pair.surface)
        continue;
      const double spread = deviation * pair.deviation;
      const double limit = std::max(scale, kKernelDeviations * spread);
      const double kernel =
          limit * limit / (limit * limit + pair.distance * pair.distance);
      const double weight = kernel * kernel / (spread * spread * options_.correlation);
      const SweepPart at(points_[i].share, num_parts_);
      Twist row;
      if (pair.surface->shape == VoxelShape::kPlane) {
        row << pair.surface->normal, pair.arm.cross(pair.surface->normal);
        sums[at.part].add(row, pair.distance, weight, at.share);
        continue;
      }
      for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
        row << unit, pair.arm.cross(unit);
        sums[at.part].add(row, pair.offset(axis), weight, at.share);
      }
    }
    return sums;
  }

  /** \return the motions of begin and end, with those between the parts in between */
  Eigen::VectorXd
  solve(const SweepMatch& match, double scale)
  {
    std::vector<std::vector<PartSums>> partial((points_.size() + kPointsPerBlock - 1) /
                                               kPointsPerBlock);
    parallelBlocks(
        points_.size(), kPointsPerBlock, options_.num_threads, [&](const Block& block) {
          partial[block.index] = sumsOf(block, match.deviation, scale);
        });
    SweepEquations equations(mergeTree(std::move(partial), added));
    if (prior_.holds_open)
      equations.project(fixedPart(match.deviation));
    equations.add(prior_, match.motion);
    normal_ = equations.normal();
    return equations.solve();
  }

  Eigen::Isometry3d
  moved(const Eigen::Isometry3d& pose, const Twist& step) const
  {
    const Eigen::Translation3d there(prior_.centre), back(-prior_.centre);
    return exactlyRigid(there * motionFromTwist(step) * back * pose);
  }

  void
  move(const Eigen::VectorXd& step, SweepMotion& motion) const
  {
    std::vector<Eigen::Isometry3d> between;
    const auto shareOf = [this](std::size_t part) {
      return static_cast<double>(part) / static_cast<double>(num_parts_);
    };
    for (std::size_t part = 1; part < num_parts_; ++part)
      between.push_back(
          moved(motion.begin * motionFromTwist(motion.twistAt(shareOf(part))),
                step.segment<6>(static_cast<Eigen::Index>(6 * part))));
    const Eigen::Isometry3d end = moved(motion.end(), step.tail<6>());
    motion.begin = moved(motion.begin, step.head<6>());
    const Twist velocity = twistFromMotion(motion.begin.inverse() * end);
    motion.change += velocity - motion.velocity;
    motion.velocity = velocity;
    motion.offsets.clear();
    if (between.empty())
      return;
    std::vector<Twist> offsets(num_parts_ + 1, Twist::Zero());
    for (std::size_t part = 1; part < num_parts_; ++part)
      offsets[part] = twistFromMotion(motion.begin.inverse() * between[part - 1]) -
                      motion.twistAt(shareOf(part));
    motion.offsets = std::move(offsets);
  }

  void
  describe(SweepMatch& match) const
  {
    std::vector<const MapSurface*> surfaces;
    std::vector<double> distances;
    for (const Pair& pair : pairs_) {
      if (!pair.surface)
        continue;
      surfaces.push_back(pair.surface);
      if (pair.surface->shape == VoxelShape::kPlane)
        distances.push_back(std::abs(pair.distance));
      match.inliers +=
          pair.normalised() <= kKernelDeviations * std::max(1.0, match.deviation);
    }
    match.distance = upperMedian(std::move(distances));
    match.overlap =
        static_cast<double>(match.inliers) / static_cast<double>(points_.size());
    const auto count = static_cast<double>(surfaces.size());
    match.fit = static_cast<double>(match.inliers) / count;
    std::sort(surfaces.begin(), surfaces.end(), std::less<const MapSurface*>());
    const auto last = std::unique(surfaces.begin(), surfaces.end());
    match.correlation =
        std::max(1.0, count / static_cast<double>(last - surfaces.begin()));
    const Eigen::MatrixXd covariance =
        normal_.ldlt().solve(Eigen::MatrixXd::Identity(normal_.rows(), normal_.cols()));
    match.covariance << covariance.topLeftCorner<6, 6>(),
        covariance.topRightCorner<6, 6>(), covariance.bottomLeftCorner<6, 6>(),
        covariance.bottomRightCorner<6, 6>();
    match.free_directions = localizability(match.deviation).openDirections();
  }

  /** \return how well the planes fix each motion about the centre */
  Localizability
  localizability(double deviation) const
  {
    PlaneAccumulator sums;
    for (const Pair& pair : pairs_)
      if (pair.isOnPlane(deviation))
        sums.add(pair.arm,
                 pair.arm - pair.distance * pair.surface->normal,
                 pair.surface->normal);
    return localizabilityOf(sums.sums());
  }

  /** \return the projection of motions on those that the planes fix: without the open ones, to
   * which the fixed ones are orthogonal by the displacements of the points */
  Matrix6
  fixedPart(double deviation) const
  {
    const Localizability fixed = localizability(deviation);
    const int num_open = fixed.openDirections();
    Matrix6 part = Matrix6::Identity();
    if (num_open == 0)
      return part;
    Matrix6 metric = Matrix6::Zero();
    double count = 0;
    for (const Pair& pair : pairs_)
      if (pair.isOnPlane(deviation)) {
        Eigen::Matrix<double, 3, 6> moved;
        moved << Eigen::Matrix3d::Identity(), -skew(pair.arm);
        metric += moved.transpose() * moved;
        ++count;
      }
    for (int k = 0; k < num_open; ++k) {
      Twist open = fixed.directions.col(k); // about the centroid
      open.head<3>() -= Eigen::Vector3d(open.tail<3>()).cross(fixed.centroid);
      part -= open * (open.transpose() * metric) / count;
    }
    return part;
  }

  const LocalMap& map_;
  const SweepPoints& points_;
  const SweepPrior& prior_;
  const SweepMatchOptions& options_;
  const std::size_t num_parts_; ///< of the sweep, each with a velocity of its own
  std::vector<Pair> pairs_;
  double reach_ = 1; ///< [m] rms distance of the points from the centre
  Eigen::MatrixXd normal_;
};
} // namespace

SweepMatch
matchSweep(const LocalMap& map,
           const SweepPoints& points,
           const SweepPrior& prior,
           const SweepMatchOptions& options)
{
  return Match(map, points, prior, options).run();
}

} // namespace pcl6d::odometry
