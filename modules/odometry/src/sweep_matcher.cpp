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

/** Sums of the normal equations of a part of the sweep, split by the shares of begin and end. */
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

/** One for each part of the sweep. */
using PartSums = std::vector<Sums>;

PartSums
added(PartSums a, const PartSums& b)
{
  for (std::size_t part = 0; part < a.size(); ++part)
    a[part] = a[part] + b[part];
  return a;
}

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

  PartSums
  sumsOf(const Block& block, double deviation, double scale) const
  {
    PartSums sums(num_parts_);
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
    std::vector<PartSums> partial((points_.size() + kPointsPerBlock - 1) /
                                  kPointsPerBlock);
    parallelBlocks(
        points_.size(), kPointsPerBlock, options_.num_threads, [&](const Block& block) {
          partial[block.index] = sumsOf(block, match.deviation, scale);
        });
    Eigen::VectorXd side = setData(mergeTree(std::move(partial), added));
    if (prior_.holds_open)
      holdOpen(match.deviation, side);
    addPrior(match.motion, side);
    if (num_parts_ > 1)
      addSteadiness(match.motion, side);
    return normal_.ldlt().solve(-side);
  }

  /** Sets the normal equations. \return the side */
  Eigen::VectorXd
  setData(const PartSums& data)
  {
    const auto size = static_cast<Eigen::Index>(6 * (data.size() + 1));
    normal_.setZero(size, size);
    Eigen::VectorXd side = Eigen::VectorXd::Zero(size);
    Eigen::Index at = 0;
    for (const Sums& part : data) {
      normal_.block<6, 6>(at, at) += full(part.begin);
      normal_.block<6, 6>(at + 6, at) += full(part.mixed);
      normal_.block<6, 6>(at, at + 6) += full(part.mixed);
      normal_.block<6, 6>(at + 6, at + 6) += full(part.end);
      side.segment<6>(at) += part.begin_side;
      side.segment<6>(at + 6) += part.end_side;
      at += 6;
    }
    return side;
  }

  void
  holdOpen(double deviation, Eigen::VectorXd& side)
  {
    const Matrix6 fixed = fixedPart(deviation);
    for (Eigen::Index r = 0; r < side.size(); r += 6) {
      side.segment<6>(r) = (fixed.transpose() * side.segment<6>(r)).eval();
      for (Eigen::Index c = 0; c < side.size(); c += 6)
        normal_.block<6, 6>(r, c) =
            (fixed.transpose() * normal_.block<6, 6>(r, c) * fixed).eval();
    }
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

  /** \return the information of a motion with the deviations of the velocity, times a factor */
  Matrix6
  velocityInformation(double factor) const
  {
    const double t = factor * prior_.translation, r = factor * prior_.rotation;
    Matrix6 information = Matrix6::Zero();
    information.diagonal() << Eigen::Vector3d::Constant(1 / (t * t)),
        Eigen::Vector3d::Constant(1 / (r * r));
    return information;
  }

  void
  addPrior(const SweepMotion& motion, Eigen::VectorXd& side)
  {
    const Matrix6& begin = prior_.begin_information;
    const Twist off_begin = errorOf(motion.begin, prior_.motion.begin);
    normal_.topLeftCorner<6, 6>() += begin;
    side.head<6>() += begin * off_begin;
    const Twist off_velocity =
        errorOf(motion.end(), motion.begin * motionFromTwist(prior_.motion.velocity));
    const Matrix6 steady = velocityInformation(1);
    // The centre is near the scanner: a change of its velocity is a change about the centre.
    normal_.topLeftCorner<6, 6>() += steady;
    normal_.bottomRightCorner<6, 6>() += steady;
    normal_.topRightCorner<6, 6>() -= steady;
    normal_.bottomLeftCorner<6, 6>() -= steady;
    side.head<6>() -= steady * off_velocity;
    side.tail<6>() += steady * off_velocity;
  }

  /** The velocity changes as a random walk from part to part; where it does, the motion bends. */
  void
  addSteadiness(const SweepMotion& motion, Eigen::VectorXd& side)
  {
    const auto parts = static_cast<double>(num_parts_);
    const Matrix6 steady = velocityInformation(1 / (parts * std::sqrt(parts)));
    constexpr std::array<double, 3> kBend = {1, -2, 1};
    for (std::size_t part = 0; part + 1 < num_parts_; ++part) {
      Twist bend = Twist::Zero();
      if (!motion.offsets.empty())
        bend = motion.offsets[part] - 2 * motion.offsets[part + 1] +
               motion.offsets[part + 2];
      bend.head<3>() = motion.begin.linear() * Eigen::Vector3d(bend.head<3>());
      bend.tail<3>() = motion.begin.linear() * Eigen::Vector3d(bend.tail<3>());
      const auto at = static_cast<Eigen::Index>(6 * part);
      for (int r = 0; r < 3; ++r) {
        side.segment<6>(at + 6 * r) += kBend[r] * steady * bend;
        for (int c = 0; c < 3; ++c)
          normal_.block<6, 6>(at + 6 * r, at + 6 * c) += kBend[r] * kBend[c] * steady;
      }
    }
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
    const Eigen::MatrixXd covariance =
        normal_.ldlt().solve(Eigen::MatrixXd::Identity(normal_.rows(), normal_.cols()));
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
