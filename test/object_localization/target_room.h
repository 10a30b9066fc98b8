// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/points.h"

#include <pcl6d/common/random.h>

#include <Eigen/Geometry>

#include <cmath>
#include <vector>

/** \file Terrestrial scans of a room with targets of known centres. */
namespace pcl6d::test {

constexpr double kTargetNoise = 0.002;            // [m] of a range
constexpr double kTargetStep = 0.0022;            // [rad] an eighth of a degree
constexpr double kDiameter = 0.145, kSize = 0.15; // [m]

struct Ball {
  Eigen::Vector3d centre;
  double diameter = kDiameter;
};

struct Square {
  Eigen::Vector3d centre, normal; ///< unit
  double size = kSize;
  double turn = 0.3; ///< [rad] of the quarters
};

/** A room of 8 x 6 x 3 m with the scanner amid, of which only targets are scanned finely. */
struct TargetRoom {
  std::vector<Ball> balls;
  std::vector<Square> squares;
  std::vector<Ball> screens; ///< discs that face the scanner, as people who hide others

  struct Hit {
    double range;
    double brightness;
  };

  Hit
  castAt(const Eigen::Vector3d& ray) const
  {
    const Eigen::Vector3d half(4, 3, 1.5);
    Hit hit{1e9, 0.6};
    for (int k = 0; k < 3; ++k)
      hit.range = std::min(hit.range, half(k) / std::max(1e-9, std::abs(ray(k))));
    for (const Ball& ball : balls) {
      const double along = ray.dot(ball.centre);
      const double inner = ball.diameter * ball.diameter / 4 -
                           (ball.centre.squaredNorm() - along * along);
      if (inner > 0 && along - std::sqrt(inner) < hit.range)
        hit = {along - std::sqrt(inner), 0.8};
    }
    for (const Ball& screen : screens) {
      const Eigen::Vector3d normal = screen.centre.normalized();
      const double range = screen.centre.norm() / ray.dot(normal);
      if (range > 0 && range < hit.range &&
          (range * ray - screen.centre).norm() < screen.diameter / 2)
        hit = {range, 0.4};
    }
    for (const Square& square : squares) {
      const double range = square.normal.dot(square.centre) / square.normal.dot(ray);
      const Eigen::Vector3d right = square.normal.unitOrthogonal();
      const Eigen::Vector3d place = range * ray - square.centre;
      const Eigen::Vector2d p =
          Eigen::Rotation2Dd(-square.turn) *
          Eigen::Vector2d(place.dot(right), place.dot(square.normal.cross(right)));
      if (range > 0 && range < hit.range + 1e-3 &&
          p.cwiseAbs().maxCoeff() < square.size / 2)
        hit = {range, p.x() * p.y() > 0 ? 0.9 : 0.1};
    }
    return hit;
  }

  /** \return the points, with their brightness */
  Points
  scan(std::uint64_t seed, std::vector<float>& intensity) const
  {
    Random random(seed);
    Points points;
    for (double height = -1.0; height < 1.0; height += kTargetStep)
      for (double turn = -M_PI; turn < M_PI; turn += kTargetStep) {
        const Eigen::Vector3d ray(std::cos(height) * std::cos(turn),
                                  std::cos(height) * std::sin(turn),
                                  std::sin(height));
        if (!isNearTarget(ray))
          continue;
        const Hit hit = castAt(ray);
        points.push_back(
            ((hit.range + kTargetNoise * random.normal()) * ray).cast<float>());
        intensity.push_back(
            static_cast<float>(hit.brightness + 0.03 * random.normal()));
      }
    return points;
  }

private:
  /** Only the surroundings of targets are scanned: 0.14 rad. */
  bool
  isNearTarget(const Eigen::Vector3d& ray) const
  {
    const auto isNear = [&](const Eigen::Vector3d& centre) {
      return ray.dot(centre.normalized()) > 0.99;
    };
    for (const Ball& ball : balls)
      if (isNear(ball.centre))
        return true;
    for (const Square& square : squares)
      if (isNear(square.centre))
        return true;
    return isNear({-4, -3, 1.5}); // a corner of the room, too
  }
};

} // namespace pcl6d::test
