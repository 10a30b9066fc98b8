// SPDX-License-Identifier: BSD-3-Clause
#include "manhattan_frames.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/rotation.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl6d::scene_interpretation {
namespace {
constexpr double kQuarter = 1.5707963267948966; // [rad] 90 deg
using Kind = ExactDirection::Kind;

// A wall by its azimuth about the vertical.
struct Wall {
  std::size_t plane = 0;
  double azimuth = 0;  // [rad]
  double variance = 0; // [rad^2]
};

std::vector<Wall>
wallsOf(const std::vector<FittedPlane>& planes,
        const std::vector<ExactDirection>& directions,
        const Eigen::Vector3d& up,
        const Eigen::Vector3d& east)
{
  std::vector<Wall> walls;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (directions[i].kind != Kind::kAlong && directions[i].kind != Kind::kAcross)
      continue;
    const Eigen::Vector3d& n = planes[i].normal;
    const Eigen::Vector3d aside = up.cross(n).normalized();
    walls.push_back({i,
                     portableAtan2(n.dot(up.cross(east)), n.dot(east)),
                     aside.dot(planes[i].covariance * aside)});
  }
  return walls;
}

// Deviation of two walls from parallel or orthogonal [rad].
double
missOf(const Wall& a, const Wall& b)
{
  return std::abs(std::remainder(a.azimuth - b.azimuth, kQuarter));
}

// Heading of walls modulo 90 degrees, weighted by area.
double
meanHeading(const std::vector<Wall>& walls, const std::vector<FittedPlane>& planes)
{
  double sine = 0, cosine = 0;
  for (const auto& wall : walls) {
    const SinCos fourfold = portableSinCos(4 * wall.azimuth);
    sine += planes[wall.plane].area * fourfold.sin;
    cosine += planes[wall.plane].area * fourfold.cos;
  }
  return portableAtan2(sine, cosine) / 4;
}

// Moves the walls of the frame with the most area out of the list. A frame consists of
// the walls in agreement with one wall.
std::vector<Wall>
takeLargestFrame(std::vector<Wall>& walls,
                 const std::vector<FittedPlane>& planes,
                 double significance)
{
  const auto goWith = [&](const Wall& a, const Wall& b) {
    return missOf(a, b) <= significance * std::sqrt(a.variance + b.variance);
  };
  std::size_t best = 0;
  double best_area = -1;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    double area = 0;
    for (const auto& wall : walls)
      if (goWith(walls[i], wall))
        area += planes[wall.plane].area;
    if (area > best_area) {
      best_area = area;
      best = i;
    }
  }
  const Wall seed = walls[best];
  const auto rest = std::stable_partition(
      walls.begin(), walls.end(), [&](const Wall& w) { return !goWith(seed, w); });
  std::vector<Wall> frame(rest, walls.end());
  walls.erase(rest, walls.end());
  return frame;
}

void
addFrame(const std::vector<Wall>& walls,
         const std::vector<FittedPlane>& planes,
         const Eigen::Vector3d& east,
         DirectionFrames& frames,
         std::vector<ExactDirection>& directions)
{
  const double heading = meanHeading(walls, planes);
  const SinCos angle = portableSinCos(heading);
  frames.headings.push_back(angle.cos * east + angle.sin * frames.up.cross(east));
  for (const auto& wall : walls) {
    const double quarters = std::round((wall.azimuth - heading) / kQuarter);
    const bool is_across = std::fmod(std::abs(quarters), 2.0) == 1;
    directions[wall.plane].kind = is_across ? Kind::kAcross : Kind::kAlong;
    directions[wall.plane].frame = frames.headings.size() - 1;
  }
}

// Derivatives of the exact normal of a plane by the unknowns: a common turn (first
// three, unless the vertical is kept), and a turn of each heading about the vertical.
Eigen::MatrixXd
derivative(const ExactDirection& direction, bool keep_up, const DirectionFrames& frames)
{
  const Eigen::Index turn = keep_up ? 0 : 3;
  const Eigen::Index skipped = keep_up ? 0 : 1; // first heading: turned by the common
                                                // turn
  const auto count = static_cast<Eigen::Index>(frames.headings.size());
  const Eigen::Vector3d n = frames.normal(direction);
  Eigen::MatrixXd J =
      Eigen::MatrixXd::Zero(3, turn + std::max<Eigen::Index>(count - skipped, 0));
  if (!keep_up)
    J.leftCols<3>() = -skew(n);
  const auto frame = static_cast<Eigen::Index>(direction.frame);
  if (direction.kind != Kind::kUp && frame >= skipped)
    J.col(turn + frame - skipped) = frames.up.cross(n);
  return J;
}

Eigen::VectorXd
pseudoSolve(const Eigen::MatrixXd& H, const Eigen::VectorXd& g)
{
  constexpr double kSmall = 1e-10; // relative: undetermined directions
  const auto eigen = symmetricEigen<Eigen::Dynamic>(H);
  const Eigen::VectorXd& values = eigen.values;
  Eigen::VectorXd part = eigen.vectors.transpose() * g;
  for (Eigen::Index i = 0; i < part.size(); ++i)
    part(i) = values(i) > kSmall * values.maxCoeff() ? part(i) / values(i) : 0;
  return eigen.vectors * part;
}

void
turnBy(const Eigen::VectorXd& step, bool keep_up, DirectionFrames& frames)
{
  const std::size_t skipped = keep_up ? 0 : 1;
  const Eigen::Index turn = keep_up ? 0 : 3;
  const Eigen::Vector3d up = frames.up;
  for (std::size_t k = skipped; k < frames.headings.size(); ++k)
    frames.headings[k] =
        rotationFromVector(step(turn + static_cast<Eigen::Index>(k - skipped)) * up) *
        frames.headings[k];
  const Eigen::Matrix3d R =
      keep_up ? Eigen::Matrix3d::Identity().eval() : rotationFromVector(step.head<3>());
  frames.up = (R * up).normalized();
  for (auto& heading : frames.headings) {
    heading = R * heading;
    heading = (heading - heading.dot(frames.up) * frames.up).normalized();
  }
}
} // namespace

Eigen::Vector3d
DirectionFrames::normal(const ExactDirection& direction) const
{
  if (direction.kind == Kind::kUp)
    return up;
  const Eigen::Vector3d& heading = headings[direction.frame];
  return direction.kind == Kind::kAlong ? heading : up.cross(heading);
}

DirectionFrames
gatherFrames(const std::vector<FittedPlane>& planes,
             const Eigen::Vector3d& up,
             double significance,
             const std::vector<bool>& alone,
             std::vector<ExactDirection>& directions)
{
  DirectionFrames frames;
  frames.up = up;
  const Eigen::Vector3d axis =
      std::abs(up.x()) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d east = (axis - axis.dot(up) * up).normalized();
  std::vector<Wall> walls = wallsOf(planes, directions, up, east);
  const auto rest = std::stable_partition(
      walls.begin(), walls.end(), [&](const Wall& w) { return !alone[w.plane]; });
  const std::vector<Wall> loners(rest, walls.end());
  walls.erase(rest, walls.end());
  while (!walls.empty())
    addFrame(takeLargestFrame(walls, planes, significance),
             planes,
             east,
             frames,
             directions);
  for (const auto& wall : loners)
    addFrame({wall}, planes, east, frames, directions);
  return frames;
}

void
optimiseFrames(const std::vector<FittedPlane>& planes,
               const std::vector<ExactDirection>& directions,
               bool keep_up,
               DirectionFrames& frames)
{
  constexpr int kMaxSteps = 30;
  constexpr double kSmallStep = 1e-13; // [rad]
  for (int i = 0; i < kMaxSteps; ++i) {
    Eigen::MatrixXd H;
    Eigen::VectorXd g;
    for (std::size_t p = 0; p < planes.size(); ++p) {
      if (directions[p].kind == Kind::kFree)
        continue;
      const Eigen::MatrixXd J = derivative(directions[p], keep_up, frames);
      const Eigen::MatrixXd AJ = planes[p].information * J;
      if (H.size() == 0) {
        H = Eigen::MatrixXd::Zero(J.cols(), J.cols());
        g = Eigen::VectorXd::Zero(J.cols());
      }
      H += J.transpose() * AJ;
      g += AJ.transpose() * frames.normal(directions[p]);
    }
    if (H.size() == 0)
      return;
    const Eigen::VectorXd step = -pseudoSolve(H, g);
    turnBy(step, keep_up, frames);
    if (step.norm() < kSmallStep)
      return;
  }
}

} // namespace pcl6d::scene_interpretation
