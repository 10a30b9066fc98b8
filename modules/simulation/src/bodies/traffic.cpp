// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/simulation/body_ways.h>
#include <pcl6d/simulation/ground_survey.h>
#include <pcl6d/simulation/traffic.h>

#include <cmath>

namespace pcl6d {
namespace {
constexpr double kTrackStep = 0.25; // [s] between known positions of the robot
constexpr int kSightTries = 8;      // tries to find a position in sight

// Positions of the robot, at the scans and in between.
ScannerTrack
trackOf(const Simulator& drive)
{
  const double end = drive.truth().stamps.back() + drive.scanner().duration();
  require(end <= kLongestTrack,
          "duration of the drive [s]",
          end,
          "at most 1e5 where bodies move");
  const int moments = std::max(1, static_cast<int>(std::ceil(end / kTrackStep)));
  ScannerTrack track;
  for (int i = 0; i <= moments; ++i) {
    track.times.push_back(end * i / moments);
    track.places.push_back(drive.poseAt(track.times.back()).translation());
  }
  return track;
}

// Positions along the way, without duplicates.
std::vector<Eigen::Vector3d>
densely(const std::vector<Eigen::Vector3d>& places)
{
  constexpr double kStep = 0.5; // [m]
  std::vector<Eigen::Vector3d> all = {places.front()};
  for (const auto& place : places)
    if ((place - all.back()).norm() >= kStep)
      all.push_back(place);
  return all;
}
} // namespace

void
TrafficOptions::validate() const
{
  require(people >= 0 && people <= kMostBodies, "people", people, "in [0, 200]");
  require(cars >= 0 && cars <= kMostBodies, "cars", cars, "in [0, 200]");
}

void
addTraffic(SimulationScene& scene,
           const Simulator& drive,
           const TrafficOptions& options)
{
  options.validate();
  if (options.people + options.cars == 0)
    return;
  const ScannerTrack track = trackOf(drive);
  const double reach =
      wayRules(options.cars > 0 ? BodyKind::kCar : BodyKind::kPerson).farthest;
  const GroundMap map = groundOfScene(drive.caster(),
                                      densely(track.places),
                                      drive.options().robot.sensor_height,
                                      reach);
  // Around the robot, in direct view.
  const auto goalAt =
      [&](double time, double nearest, double farthest, Random& random) {
        const Eigen::Vector2d robot = track.placeAt(time).head<2>();
        Eigen::Vector2d goal = robot;
        for (int i = 0; i < kSightTries; ++i) {
          const SinCos turn = portableSinCos(random.uniform(0, 2 * M_PI));
          goal = robot + random.uniform(nearest, farthest) *
                             Eigen::Vector2d(turn.cos, turn.sin);
          if (map.isFree(robot, goal, 0))
            break;
        }
        return goal;
      };
  BodyWays ways(map, track, goalAt);
  for (const auto& body : scene.moving)
    ways.addOther(body);
  std::uint64_t seed = mixBits(options.seed);
  for (int i = 0; i < options.cars; ++i)
    scene.addMoving(ways.add(BodyKind::kCar, ++seed));
  for (int i = 0; i < options.people; ++i)
    scene.addMoving(ways.add(BodyKind::kPerson, ++seed));
}

} // namespace pcl6d
