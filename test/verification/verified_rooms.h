// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/room.h"

#include <pcl6d/filters/voxel_reduction.h>
#include <pcl6d/verification/verified_scan.h>

#include <cmath>
#include <cstddef>
#include <deque>
#include <string>
#include <utility>
#include <vector>

namespace pcl6d::test {

constexpr double kVoxel = 0.15;    // [m]
constexpr double kRayStep = 0.025; // [rad] 17 000 rays

/** \return options of the surfaces that verification works with, as Slam6D makes them */
inline IcpModel::Options
surfaceOptions(double voxel = kVoxel)
{
  IcpModel::Options options;
  options.normals = true;
  options.neighbours = 10;
  options.normal_voxel = 3 * voxel;
  options.num_threads = 1;
  return options;
}

/** \brief Scans made ready for verification, with the surfaces that they refer to. */
class VerifiedScans {
public:
  void
  add(const Points& measured,
      double voxel = kVoxel,
      const Eigen::Vector3f& origin = Eigen::Vector3f::Zero())
  {
    ReductionOptions reduction;
    reduction.voxel = voxel;
    models_.emplace_back(reducePoints(measured, reduction), surfaceOptions(voxel));
    scans_.emplace_back(measured, models_.back(), voxel, origin);
  }
  const VerifiedScan&
  operator[](std::size_t i) const
  {
    return scans_[i];
  }
  const std::deque<VerifiedScan>&
  all() const
  {
    return scans_;
  }

private:
  std::deque<IcpModel> models_; ///< a deque: scans refer to its elements
  std::deque<VerifiedScan> scans_;
};

/** \brief Two scans of a room from places 1.4 m apart. */
struct ScannedPair {
  explicit ScannedPair(const PillarRoom& room = {},
                       double sigma = 0.005,
                       std::uint64_t seed = 5)
  {
    Random random(seed);
    first = room.scan(T_world_first, random, kRayStep, sigma);
    second = room.scan(T_world_first * T_first_second, random, kRayStep, sigma);
  }
  Eigen::Isometry3d T_world_first = poseFromEuler({0.2, -0.4, 0.1}, {0.02, -0.03, 0.5});
  Eigen::Isometry3d T_first_second =
      poseFromEuler({1.2, 0.7, -0.1}, {0.03, 0.02, -0.8}); ///< the truth
  Points first, second;

  VerifiedScans
  verified(double scale = 1) const
  {
    VerifiedScans scans;
    for (const Points* points : {&first, &second})
      scans.add(scaled(*points, scale), scale * kVoxel);
    return scans;
  }

  static Points
  scaled(Points points, double scale)
  {
    for (auto& p : points)
      p = (scale * p.cast<double>()).cast<float>();
    return points;
  }
};

/** \return the motion that turns a room without its pillars into itself: half a turn about
 * the middle of its walls */
inline Eigen::Isometry3d
foldOf(const PillarRoom& room)
{
  const Eigen::Vector3d middle = room.walls.center();
  return Eigen::Translation3d(middle) *
         Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ()) *
         Eigen::Translation3d(-middle);
}

/** \return a pose moved by a way [m] in the frame that it is seen from */
inline Eigen::Isometry3d
shifted(const Eigen::Isometry3d& T, const Eigen::Vector3d& way)
{
  return Eigen::Translation3d(way) * T;
}

/** \return a corridor along x of 3 x 2.5 m without ends: its walls are farther away than
 * any range of these scans */
inline PillarRoom
endlessCorridor()
{
  PillarRoom room;
  room.walls = {Eigen::Vector3d(-1e4, -1.5, -1), Eigen::Vector3d(1e4, 1.5, 1.5)};
  room.pillars.clear();
  return room;
}

/** \return a scan whose platform turned and went on while it measured: every second point
 * is seen from elsewhere. Its rays contradict its own points. */
inline Points
spoilt(Points points)
{
  const Eigen::Isometry3d motion = poseFromEuler({0.8, 0.5, 0}, {0, 0, 0.5});
  for (std::size_t i = 1; i < points.size(); i += 2)
    points[i] = (motion * points[i].cast<double>()).cast<float>();
  return points;
}

/** \return the points within a range [m] */
inline Points
within(const Points& points, float range)
{
  Points kept;
  for (const auto& p : points)
    if (p.norm() < range)
      kept.push_back(p);
  return kept;
}

inline std::vector<std::string>
namesOf(std::size_t count)
{
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i)
    names.push_back("scan " + std::to_string(i));
  return names;
}

constexpr std::size_t kRoomScans = 6;

/** \return poses of kRoomScans scans along a path through the room, with roll, pitch and yaw */
inline std::vector<Eigen::Isometry3d>
roomPoses()
{
  std::vector<Eigen::Isometry3d> poses;
  for (std::size_t i = 0; i < kRoomScans; ++i) {
    const double s = static_cast<double>(i);
    poses.push_back(poseFromEuler({-1.5 + s, 0.5 * std::sin(s), 0.1 * std::cos(s)},
                                  {0.03 * std::sin(s), 0.02, 0.4 * s}));
  }
  return poses;
}

} // namespace pcl6d::test
