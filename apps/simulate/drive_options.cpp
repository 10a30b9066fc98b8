// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "simulate/drive_options.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <utility>

namespace pcl6d::app {

void
describeDrive(CommandLine& line, DriveWords& words)
{
  line.group("Drive").add_options() //
      ("motion",
       valueOf(words.motion),
       "stop|continuous: stop for each scan, or drive on meanwhile; then points have "
       "the field t, and times.txt has the stamps") //
      ("speed",
       valueOf(words.speed),
       "[m/s] or auto: 1, slower if a scan takes longer than the way to the next") //
      ("odometry",
       valueOf(words.odometry),
       "wheel|visual-inertial|exact: planar with drift, six degrees of freedom with "
       "little drift, the truth");
}

void
applyDrive(const DriveWords& words, SimulationOptions& options)
{
  checkOptions([&] {
    options.motion = scanMotionFromName(words.motion);
    options.odometry_kind = odometryKindFromName(words.odometry);
  });
  if (!words.speed.is_auto)
    options.speed = words.speed.value;
}

Simulator
startDrive(const SimulationScene& scene, const SimulationOptions& options)
{
  std::optional<Simulator> simulator;
  checkOptions([&] { simulator.emplace(scene, options); });
  return *std::move(simulator);
}

nlohmann::ordered_json
describedDrive(const DriveWords& words, const Simulator& simulator)
{
  auto json = nlohmann::ordered_json::object();
  if (words.motion != DriveWords().motion)
    json["motion"] = {{"kind", words.motion}, {"speed", simulator.speed()}};
  if (words.odometry != DriveWords().odometry)
    json["odometry"] = words.odometry;
  return json;
}

} // namespace pcl6d::app
