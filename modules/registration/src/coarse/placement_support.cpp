// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/placement_support.h"

#include <pcl6d/common/rotation.h>
#include <pcl6d/registration/localizability.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::registration {

namespace {
constexpr float kLikeNormal = 0.8f; // cosine of 37 degrees

/** Standard deviation of a point, as a share of the distance for partners: three deviations are
 * twice this distance. */
constexpr double kPlaceSigma = 2.0 / 3;

/** Support of the points of one scan, seen from the other. */
Support
supportBy(const PlacedScan& other,
          const FeatureScan& scan,
          const Eigen::Isometry3d& T_other_scan,
          double distance,
          std::size_t step)
{
  Support support;
  const auto distance_sq = static_cast<float>(distance * distance);
  const auto sigma = static_cast<float>(kPlaceSigma * distance);
  const Eigen::Matrix3f R = T_other_scan.linear().cast<float>();
  for (std::size_t i = 0; i < scan.points.size(); i += step) {
    const Eigen::Vector3f p =
        (T_other_scan * scan.points[i].cast<double>()).cast<float>();
    ++support.points;
    const int found = other.scan.tree.nearest(p, distance_sq).index;
    if (found < 0) {
      support.contradicted += other.rays.look(p, sigma).sight == Sight::kFree ? 1 : 0;
      continue;
    }
    const auto &n = scan.normals[i], &m = other.scan.normals[found];
    if (n.isZero(0) || m.isZero(0) || (R * n).dot(m) > kLikeNormal)
      ++support.met;
  }
  return support;
}

/** Constraints of the target's surfaces on small motions of the source's points. */
PlaneSums
heldBy(const FeatureScan& target,
       const FeatureScan& source,
       const Eigen::Isometry3d& T_target_source,
       double distance)
{
  PlaneAccumulator held;
  const auto distance_sq = static_cast<float>(distance * distance);
  for (const auto& s : source.points) {
    const Eigen::Vector3d p = T_target_source * s.cast<double>();
    const int found = target.tree.nearest(p.cast<float>(), distance_sq).index;
    if (found >= 0)
      held.add(
          p, target.points[found].cast<double>(), target.normals[found].cast<double>());
  }
  return held.sums();
}
} // namespace

double
PlacementSupport::overlap() const
{
  const auto share = [](const Support& s) {
    return s.points > 0 ? static_cast<double>(s.met) / static_cast<double>(s.points)
                        : 0;
  };
  return std::max(share(source), share(target));
}

double
PlacementSupport::consistency() const
{
  const auto met = static_cast<double>(source.met + target.met);
  const auto contradicted =
      static_cast<double>(source.contradicted + target.contradicted);
  return met > 0 ? met / (met + contradicted) : 0;
}

double
PlacementSupport::value() const
{
  return overlap() * consistency();
}

PlacementSupport
supportOf(const PlacedScan& target,
          const PlacedScan& source,
          const Eigen::Isometry3d& T_target_source,
          double distance,
          std::size_t step)
{
  return {supportBy(target, source.scan, T_target_source, distance, step),
          supportBy(source, target.scan, T_target_source.inverse(), distance, step)};
}

std::vector<Eigen::Isometry3d>
looselyHeld(const PlacedScan& target,
            const PlacedScan& source,
            const Eigen::Isometry3d& T_target_source,
            double distance,
            double way)
{
  const PlaneSums held = heldBy(target.scan, source.scan, T_target_source, distance);
  if (held.count < 6)
    return {};
  const Localizability ways = localizabilityOf(held);
  std::vector<Eigen::Isometry3d> moved;
  for (int weakest = 0; weakest < 3; ++weakest)
    for (const double to : {way, -way}) {
      const Twist step = to * ways.directions.col(weakest);
      const Eigen::Vector3d centre = held.mean_source, shift = step.head<3>();
      Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
      motion.linear() = rotationFromVector(step.tail<3>());
      motion.translation() = centre + shift - motion.linear() * centre;
      moved.push_back(motion * T_target_source);
    }
  return moved;
}

} // namespace pcl6d::registration
