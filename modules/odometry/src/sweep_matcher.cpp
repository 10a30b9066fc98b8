// SPDX-License-Identifier: BSD-3-Clause
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
using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;

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

/** Sums of the normal equations, split by the shares of begin and end. */
struct Sums {
  Matrix6 begin = Matrix6::Zero(), mixed = Matrix6::Zero(), end = Matrix6::Zero();
  Twist begin_side = Twist::Zero(), end_side = Twist::Zero();

  /** \param[in] row d distance / d motion \param[in] weight [1/m^2] */
  void
  add(const Twist& row, double distance, double weight, double share)
  {
    const double rest = 1 - share;
    const double bb = weight * rest * rest, be = weight * rest * share,
                 ee = weight * share * share;
    for (int c = 0; c < 6; ++c)
      for (int r = c; r < 6; ++r) {
        const double product = row(r) * row(c);
        begin(r, c) += bb * product;
        mixed(r, c) += be * product;
        end(r, c) += ee * product;
      }
    begin_side += (weight * rest * distance) * row;
    end_side += (weight * share * distance) * row;
  }

  friend Sums
  operator+(Sums a, const Sums& b)
  {
    a.begin += b.begin;
    a.mixed += b.mixed;
    a.end += b.end;
    a.begin_side += b.begin_side;
    a.end_side += b.end_side;
    return a;
  }
};

Matrix6
full(const Matrix6& lower)
{
  return lower.selfadjointView<Eigen::Lower>();
}

/** State of the iterations of a match. */
class Match {
public:
  Match(const LocalMap& map,
        const SweepPoints& points,
        const SweepPrior& prior,
        const SweepMatchOptions& options)
  : map_(map), points_(points), prior_(prior), options_(options), pairs_(points.size())
  {}

  SweepMatch
  run()
  {
    SweepMatch match;
    match.motion = prior_.motion;
    double scale = options_.gate;
    bool is_at_rest = false;
    while (match.iterations < options_.max_iterations) {
      ++match.iterations;
      findPairs(match.motion);
      if (!measureDeviation(match))
        return match;
      const Vector12 step = solve(match, scale);
      if (!step.allFinite()) {
        match.status = Status::kDiverged;
        return match;
      }
      move(step, match.motion);
      scale *= kDecay;
      const double moved =
          std::max(step.head<3>().norm(), step.segment<3>(6).norm()) +
          reach_ * std::max(step.segment<3>(3).norm(), step.tail<3>().norm());
      is_at_rest = scale < kKernelDeviations * options_.noise &&
                   moved < kEndShare * options_.noise;
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

  Sums
  sumsOf(const Block& block, double deviation, double scale) const
  {
    Sums sums;
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const Pair& pair = pairs_[i];
      if (!pair.surface)
        continue;
      const double spread = deviation * pair.deviation;
      const double limit = std::max(scale, kKernelDeviations * spread);
      const double kernel =
          limit * limit / (limit * limit + pair.distance * pair.distance);
      const double weight = kernel * kernel / (spread * spread * options_.correlation);
      Twist row;
      if (pair.surface->shape == VoxelShape::kPlane) {
        row << pair.surface->normal, pair.arm.cross(pair.surface->normal);
        sums.add(row, pair.distance, weight, points_[i].share);
        continue;
      }
      for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
        row << unit, pair.arm.cross(unit);
        sums.add(row, pair.offset(axis), weight, points_[i].share);
      }
    }
    return sums;
  }

  /** \return the motions of begin and end */
  Vector12
  solve(const SweepMatch& match, double scale)
  {
    std::vector<Sums> partial((points_.size() + kPointsPerBlock - 1) / kPointsPerBlock);
    parallelBlocks(
        points_.size(), kPointsPerBlock, options_.num_threads, [&](const Block& block) {
          partial[block.index] = sumsOf(block, match.deviation, scale);
        });
    data_ = mergeTree(std::move(partial), std::plus<Sums>());
    normal_.topLeftCorner<6, 6>() = full(data_.begin);
    normal_.bottomLeftCorner<6, 6>() = full(data_.mixed);
    normal_.topRightCorner<6, 6>() = full(data_.mixed);
    normal_.bottomRightCorner<6, 6>() = full(data_.end);
    Vector12 side;
    side << data_.begin_side, data_.end_side;
    if (prior_.holds_open) {
      const Matrix6 fixed = fixedPart(match.deviation);
      for (int r = 0; r < 12; r += 6) {
        side.segment<6>(r) = (fixed.transpose() * side.segment<6>(r)).eval();
        for (int c = 0; c < 12; c += 6)
          normal_.block<6, 6>(r, c) =
              (fixed.transpose() * normal_.block<6, 6>(r, c) * fixed).eval();
      }
    }
    addPrior(match.motion, side);
    return normal_.ldlt().solve(-side);
  }

  /** \return the motion from one pose to another in world axes, about the centre */
  Twist
  errorOf(const Eigen::Isometry3d& found, const Eigen::Isometry3d& expected) const
  {
    Twist error;
    error.tail<3>() = rotationVector(found.linear() * expected.linear().transpose());
    const Eigen::Vector3d arm = expected.translation() - prior_.centre;
    error.head<3>() = found.translation() - expected.translation() -
                      Eigen::Vector3d(error.tail<3>()).cross(arm);
    return error;
  }

  void
  addPrior(const SweepMotion& motion, Vector12& side)
  {
    const Matrix6& begin = prior_.begin_information;
    const Twist off_begin = errorOf(motion.begin, prior_.motion.begin);
    normal_.topLeftCorner<6, 6>() += begin;
    side.head<6>() += begin * off_begin;
    const Twist off_velocity =
        errorOf(motion.end(), motion.begin * motionFromTwist(prior_.motion.velocity));
    Matrix6 steady = Matrix6::Zero();
    steady.diagonal() << Eigen::Vector3d::Constant(
        1 / (prior_.translation * prior_.translation)),
        Eigen::Vector3d::Constant(1 / (prior_.rotation * prior_.rotation));
    // The centre is near the scanner: a change of its velocity is a change about the centre.
    normal_.topLeftCorner<6, 6>() += steady;
    normal_.bottomRightCorner<6, 6>() += steady;
    normal_.topRightCorner<6, 6>() -= steady;
    normal_.bottomLeftCorner<6, 6>() -= steady;
    side.head<6>() -= steady * off_velocity;
    side.tail<6>() += steady * off_velocity;
  }

  Eigen::Isometry3d
  moved(const Eigen::Isometry3d& pose, const Twist& step) const
  {
    const Eigen::Translation3d there(prior_.centre), back(-prior_.centre);
    return exactlyRigid(there * motionFromTwist(step) * back * pose);
  }

  void
  move(const Vector12& step, SweepMotion& motion) const
  {
    const Eigen::Isometry3d end = moved(motion.end(), step.tail<6>());
    motion.begin = moved(motion.begin, step.head<6>());
    const Twist velocity = twistFromMotion(motion.begin.inverse() * end);
    motion.change += velocity - motion.velocity;
    motion.velocity = velocity;
  }

  void
  describe(SweepMatch& match) const
  {
    std::vector<const MapSurface*> surfaces;
    for (const Pair& pair : pairs_) {
      if (!pair.surface)
        continue;
      surfaces.push_back(pair.surface);
      match.inliers +=
          pair.normalised() <= kKernelDeviations * std::max(1.0, match.deviation);
    }
    match.overlap =
        static_cast<double>(match.inliers) / static_cast<double>(points_.size());
    const auto count = static_cast<double>(surfaces.size());
    match.fit = static_cast<double>(match.inliers) / count;
    std::sort(surfaces.begin(), surfaces.end(), std::less<const MapSurface*>());
    const auto last = std::unique(surfaces.begin(), surfaces.end());
    match.correlation =
        std::max(1.0, count / static_cast<double>(last - surfaces.begin()));
    const Matrix12 covariance = normal_.ldlt().solve(Matrix12::Identity());
    match.begin_covariance = covariance.topLeftCorner<6, 6>();
    match.end_information = inverted<6>(Matrix6(covariance.bottomRightCorner<6, 6>()));
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
  std::vector<Pair> pairs_;
  double reach_ = 1; ///< [m] rms distance of the points from the centre
  Sums data_;
  Matrix12 normal_ = Matrix12::Zero();
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
