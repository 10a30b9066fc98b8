// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/line.h>

#include <cmath>

namespace pcl6d {

namespace {
/** Ratio of eigenvalues (squared sines) below which a direction is open. */
constexpr double kOpenRatio = 1e-12;

/** A line or plane as a constraint on a point: the offset is P (x - foot), with the projector P
 * onto the constrained directions. */
struct Nearness {
  Eigen::Matrix3d projector;
  Eigen::Vector3d foot;
};

Nearness
nearnessTo(const PlueckerLine& line)
{
  const Eigen::Vector3d& g = line.direction;
  return {Eigen::Matrix3d::Identity() - g * g.transpose(), line.foot()};
}

Nearness
nearnessTo(const PlaneEquation& plane)
{
  return {plane.normal * plane.normal.transpose(), plane.offset * plane.normal};
}

/** Solves about the mean foot point, to keep the digits far from the origin; among several
 * solutions returns the nearest to the mean foot point. */
template <typename Thing>
NearestPoint
leastSquares(const std::vector<Thing>& things)
{
  NearestPoint nearest;
  if (things.empty())
    return nearest;
  const double count = static_cast<double>(things.size());
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Thing& thing : things)
    centre += nearnessTo(thing).foot / count;
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (const Thing& thing : things) {
    const Nearness to = nearnessTo(thing);
    A += to.projector;
    b += to.projector * (to.foot - centre);
  }
  nearest.status = Status::kDiverged;
  if (!A.allFinite() || !b.allFinite())
    return nearest;
  nearest.status = Status::kOk;
  nearest.point = centre;
  const auto eigen = symmetricEigen<3>(A);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d along = eigen.vectors.col(k);
    if (eigen.values(k) > kOpenRatio * eigen.values(2))
      nearest.point += along * (along.dot(b) / eigen.values(k));
    else
      nearest.status = Status::kRankDeficient;
  }
  double sum = 0;
  for (const Thing& thing : things) {
    const Nearness to = nearnessTo(thing);
    sum += (to.projector * (nearest.point - to.foot)).squaredNorm();
  }
  nearest.rms = std::sqrt(sum / count);
  return nearest;
}
} // namespace

PlueckerLine
lineAlong(const Eigen::Vector3d& point, const Eigen::Vector3d& direction)
{
  return {direction, point.cross(direction)};
}

std::optional<PlueckerLine>
lineThrough(const Eigen::Vector3d& p, const Eigen::Vector3d& q)
{
  const double length = (q - p).norm();
  if (!(length > 0) || !std::isfinite(length))
    return std::nullopt;
  return lineAlong(p, (q - p) / length);
}

std::optional<PlaneEquation>
planeThrough(const PlueckerLine& line, const Eigen::Vector3d& point)
{
  // x x g - m = (x - foot) x g is normal to the plane, with the length of the offset of x.
  const Eigen::Vector3d upright = point.cross(line.direction) - line.moment;
  const double off = upright.norm();
  if (!(off > kParallelSine * point.norm()))
    return std::nullopt;
  const Eigen::Vector3d normal = upright / off;
  return PlaneEquation{normal, normal.dot(point)};
}

std::optional<PlueckerLine>
meetOf(const PlaneEquation& a, const PlaneEquation& b, double least_sine)
{
  const Eigen::Vector3d along = a.normal.cross(b.normal);
  const double sine = along.norm();
  if (!(sine > least_sine))
    return std::nullopt;
  return PlueckerLine{along / sine, (b.offset * a.normal - a.offset * b.normal) / sine};
}

std::optional<Eigen::Vector3d>
meetOf(const PlueckerLine& line, const PlaneEquation& plane, double least_sine)
{
  const double sine = plane.normal.dot(line.direction);
  if (!(std::abs(sine) > least_sine))
    return std::nullopt;
  return Eigen::Vector3d(
      (plane.offset * line.direction + plane.normal.cross(line.moment)) / sine);
}

PlueckerLine
moved(const Eigen::Isometry3d& T, const PlueckerLine& line)
{
  const Eigen::Vector3d direction = T.linear() * line.direction;
  return {direction, T.linear() * line.moment + T.translation().cross(direction)};
}

double
distanceTo(const PlueckerLine& line, const Eigen::Vector3d& point)
{
  return (point.cross(line.direction) - line.moment).norm();
}

double
distanceBetween(const PlueckerLine& a, const PlueckerLine& b)
{
  const double sine = a.direction.cross(b.direction).norm();
  if (!(sine > kParallelSine))
    return distanceTo(a, b.foot());
  return std::abs(a.direction.dot(b.moment) + b.direction.dot(a.moment)) / sine;
}

std::optional<NearestPoints>
nearestPoints(const PlueckerLine& a, const PlueckerLine& b)
{
  const Eigen::Vector3d across = a.direction.cross(b.direction);
  const double sine_sq = across.squaredNorm();
  if (!(sine_sq > kParallelSine * kParallelSine))
    return std::nullopt;
  // The point of a on the plane through b and across, and vice versa.
  const Eigen::Vector3d way = b.foot() - a.foot();
  return NearestPoints{
      a.foot() + way.cross(b.direction).dot(across) / sine_sq * a.direction,
      b.foot() + way.cross(a.direction).dot(across) / sine_sq * b.direction};
}

NearestPoint
nearestPoint(const std::vector<PlueckerLine>& lines)
{
  return leastSquares(lines);
}

NearestPoint
nearestPoint(const std::vector<PlaneEquation>& planes)
{
  return leastSquares(planes);
}

} // namespace pcl6d
