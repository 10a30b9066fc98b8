// SPDX-License-Identifier: BSD-3-Clause
// Definitions: sensor_msgs/NavSatFix, NavSatStatus and Imu.
#include "bag/messages/gnss_messages.h"

#include <array>
#include <cmath>

namespace pcl6d::sources {

namespace {
constexpr std::size_t kCovariance = 9; // numbers of a 3 x 3 matrix, row by row
constexpr std::int8_t kNoFix = -1;     // STATUS_NO_FIX
constexpr std::uint8_t kUnknownCovariance = 0;

std::array<double, kCovariance>
readCovariance(MessageReader& reader)
{
  std::array<double, kCovariance> covariance{};
  for (double& value : covariance)
    value = reader.number<double>();
  return covariance;
}

bool
isOnEarth(const GeodeticPosition& position)
{
  constexpr double kFarthest = 1e5; // [m] beyond any scanner, and far from overflow
  return std::abs(position.latitude) <= 90 && position.longitude >= -180 &&
         position.longitude <= 360 && std::abs(position.altitude) <= kFarthest;
}
} // namespace

bool
isFixType(const std::string& type)
{
  return type == "sensor_msgs/NavSatFix";
}

bool
isInertialType(const std::string& type)
{
  return type == "sensor_msgs/Imu";
}

SatelliteFix
readFix(MessageReader& reader)
{
  SatelliteFix fix;
  fix.header = reader.header();
  const auto status = reader.number<std::int8_t>();
  reader.number<std::uint16_t>(); // systems of satellites
  GeodeticPosition position;
  position.latitude = reader.number<double>();
  position.longitude = reader.number<double>();
  position.altitude = reader.number<double>();
  const auto covariance = readCovariance(reader); // east, north, up [m^2]
  const double variance = covariance[0] + covariance[4];
  if (reader.number<std::uint8_t>() != kUnknownCovariance && variance > 0 &&
      std::isfinite(variance))
    fix.sigma = std::sqrt(variance);
  if (status > kNoFix && isOnEarth(position))
    fix.position = position;
  return fix;
}

InertialOrientation
readOrientation(MessageReader& reader)
{
  InertialOrientation inertial;
  inertial.header = reader.header();
  Eigen::Quaterniond q;
  for (int i = 0; i < 4; ++i)
    q.coeffs()[i] = reader.number<double>(); // x, y, z, w
  const auto covariance = readCovariance(reader);
  if (covariance[0] == -1 || q.coeffs().isZero(0))
    return inertial;
  inertial.orientation = reader.rotation(q);
  return inertial;
}

} // namespace pcl6d::sources
