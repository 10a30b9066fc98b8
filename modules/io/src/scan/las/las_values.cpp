// SPDX-License-Identifier: BSD-3-Clause
#include "scan/las/las_bytes.h"
#include "scan/las/las_values.h"
#include "scan/pcd/pcd_header.h"
#include "scan/point_field.h"

#include <pcl6d/common/error.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl6d::io {

namespace {

using pcl::PCLPointField;

constexpr double kMostSteps = std::numeric_limits<std::int32_t>::max();
constexpr double kDegreesPerStep = 0.006; // of scan angles
// Scans are accurate to about a millimetre; rounding to a tenth is negligible.
constexpr double kUsualScale = 1e-4;  // [m]
constexpr double kFinestScale = 1e-9; // [m] of tiny scans
constexpr double kUsualSize = 10;     // [m] smaller scans have finer scales
constexpr double kGrowth = 64;        // assumed ratio of scan to part seen so far

double
numberAt(const std::uint8_t* point, const PCLPointField& field)
{
  return withTypeOf(field.datatype, [&](auto value) {
    std::memcpy(&value, point + field.offset, sizeof value);
    return static_cast<double>(value);
  });
}

bool
isCoordinate(const PCLPointField& field)
{
  return field.name == "x" || field.name == "y" || field.name == "z";
}

Eigen::Vector3d
placeAt(const std::uint8_t* point, const std::array<PCLPointField, 3>& fields)
{
  return {numberAt(point, fields[0]),
          numberAt(point, fields[1]),
          numberAt(point, fields[2])};
}

/** \return the power of ten at or below */
double
powerOfTen(double value)
{
  // By exact powers of ten: logarithms differ between C libraries.
  double power = 1, inverse = 1;
  while (1 / inverse > value && inverse < 1e300)
    inverse *= 10;
  while (10 * power <= value && power < 1e300)
    power *= 10;
  return inverse > 1 ? 1 / inverse : power;
}

} // namespace

LasValues::LasValues(const ScanShape& shape)
: T_world_scan_(shape.T_world_scan)
, lowest_(Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()))
, highest_(-lowest_)
{
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string name(1, "xyz"[axis]);
    const PCLPointField* const field = findField(shape.fields, name);
    if (!field || (field->datatype != PCLPointField::FLOAT32 &&
                   field->datatype != PCLPointField::FLOAT64))
      throw BadArgument("the cloud has no field '" + name + "' of floating point");
    place_[axis] = *field;
  }
  for (const auto& field : shape.fields)
    if (!isPadding(field) && !isCoordinate(field))
      losses_.push_back("dropped field '" + field.name + "'");
  intensity_ = take(shape.fields, {"intensity", "reflectance", "reflectivity"});
  number_ = take(shape.fields, {"return_number"});
  count_ = take(shape.fields, {"number_of_returns"});
  class_ = take(shape.fields, {"classification"});
  dynamic_ = class_ ? Field() : take(shape.fields, {"dynamic"});
  user_data_ = take(shape.fields, {"user_data"});
  angle_ = take(shape.fields, {"scan_angle"});
  source_ = take(shape.fields, {"scan", "point_source_id"});
  time_ = take(shape.fields, {"gps_time"});
  colours_ = take(shape.fields, {"rgb", "rgba"});
  if (colours_ && sizeOfType(colours_->datatype) != 4)
    colours_.reset();
}

/** \return the first named field of the cloud, removed from the losses */
LasValues::Field
LasValues::take(const std::vector<PCLPointField>& fields,
                std::initializer_list<const char*> names)
{
  for (const char* const name : names)
    if (const PCLPointField* const field = findField(fields, name)) {
      const auto lost = std::find(
          losses_.begin(), losses_.end(), "dropped field '" + std::string(name) + "'");
      if (lost != losses_.end())
        losses_.erase(lost);
      return *field;
    }
  return {};
}

void
LasValues::lookAt(const pcl::PCLPointCloud2& block, bool is_all)
{
  if (has_looked_)
    return;
  Eigen::Vector3d low = lowest_, high = highest_;
  double brightest = 0;
  bool has_fractions = false;
  for (std::size_t i = 0; i < std::size_t{block.width} * block.height; ++i) {
    const std::uint8_t* const point = &block.data[i * block.point_step];
    const Eigen::Vector3d place = T_world_scan_ * placeAt(point, place_);
    if (!place.allFinite())
      continue;
    has_looked_ = true;
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
    const double intensity = valueOf(point, intensity_, 0);
    brightest = std::max(brightest, intensity);
    has_fractions = has_fractions || intensity != std::round(intensity);
  }
  if (!has_looked_)
    return;
  offset_ = (0.5 * (low + high)).array().round();
  const double size = std::max((high - low).maxCoeff(), kFinestScale);
  // Finer for small scans; for large scans as fine as the integers permit.
  scale_ = is_all && size < kUsualSize
               ? std::max(kFinestScale, powerOfTen(size * kUsualScale / kUsualSize))
               : kUsualScale;
  if (size * kGrowth > scale_ * kMostSteps)
    scale_ = 10 * powerOfTen(size * kGrowth / kMostSteps);
  if (has_fractions && brightest <= 1)
    intensity_unit_ = std::numeric_limits<std::uint16_t>::max();
}

double
LasValues::valueOf(const std::uint8_t* point,
                   const Field& field,
                   double otherwise) const
{
  return field ? numberAt(point, *field) : otherwise;
}

/** \return a whole number within bounds; 0 for NaN */
double
LasValues::whole(double value, double least, double most)
{
  const double rounded =
      std::isnan(value) ? 0 : std::clamp(std::round(value), least, most);
  is_rounded_ = is_rounded_ || rounded != value;
  return rounded;
}

void
LasValues::encodePlace(const Eigen::Vector3d& place, std::uint8_t* record)
{
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double steps = std::round((place[axis] - offset_[axis]) / scale_);
    if (std::abs(steps) > kMostSteps)
      throw BadArgument("a point lies at " + std::string(1, "xyz"[axis]) + " = " +
                        text::shortest(place[axis]) + " m, but in steps of " +
                        text::shortest(scale_) + " m LAS reaches only " +
                        text::shortest(std::floor(kMostSteps * scale_)) + " m from " +
                        text::shortest(offset_[axis]) + ", where the first points lie");
    storeLasNumber(record + 4 * axis, static_cast<std::int32_t>(steps));
    const double kept = offset_[axis] + scale_ * steps;
    lowest_[axis] = std::min(lowest_[axis], kept);
    highest_[axis] = std::max(highest_[axis], kept);
  }
}

void
LasValues::encodeColours(const std::uint8_t* point, std::uint8_t* record) const
{
  const auto rgb = lasNumber<std::uint32_t>(point + colours_->offset);
  for (std::size_t i = 0; i < 3; ++i) // scaled to 16 bits by the specification
    storeLasNumber(record + 30 + 2 * i,
                   static_cast<std::uint16_t>((rgb >> (16 - 8 * i) & 0xff) << 8));
}

bool
LasValues::encode(const std::uint8_t* point, std::uint8_t* record)
{
  const Eigen::Vector3d place = T_world_scan_ * placeAt(point, place_);
  if (!place.allFinite())
    return false;
  encodePlace(place, record);
  const double intensity = intensity_unit_ * valueOf(point, intensity_, 0);
  storeLasNumber(record + 12, static_cast<std::uint16_t>(whole(intensity, 0, 65535)));
  const auto number = static_cast<unsigned>(whole(valueOf(point, number_, 1), 0, 15));
  const auto count = static_cast<unsigned>(whole(valueOf(point, count_, 1), 0, 15));
  record[14] = static_cast<std::uint8_t>(number | count << 4);
  record[15] = 0;
  constexpr double kMoved = 18; // "high noise": points off the surfaces
  const double by_motion = valueOf(point, dynamic_, 0) != 0 ? kMoved : 0;
  record[16] =
      static_cast<std::uint8_t>(whole(valueOf(point, class_, by_motion), 0, 255));
  record[17] = static_cast<std::uint8_t>(whole(valueOf(point, user_data_, 0), 0, 255));
  const double angle = valueOf(point, angle_, 0) / kDegreesPerStep;
  constexpr double kMostAngle = 30'000; // 180 degrees
  storeLasNumber(record + 18,
                 static_cast<std::int16_t>(
                     std::isnan(angle)
                         ? 0
                         : std::clamp(std::round(angle), -kMostAngle, kMostAngle)));
  storeLasNumber(
      record + 20,
      static_cast<std::uint16_t>(whole(valueOf(point, source_, 0), 0, 65535)));
  storeLasNumber(record + 22, valueOf(point, time_, 0));
  if (colours_)
    encodeColours(point, record);
  if (number >= 1)
    ++num_of_returns_[number - 1];
  return true;
}

std::vector<std::string>
LasValues::lossesOfPoints() const
{
  std::vector<std::string> losses;
  if (has_looked_)
    losses.push_back("rounded x, y, z to " + text::shortest(scale_) + " m");
  if (intensity_unit_ != 1)
    losses.push_back("multiplied field '" + intensity_->name + "' by " +
                     text::shortest(intensity_unit_));
  if (is_rounded_)
    losses.emplace_back("rounded attributes to whole numbers of their ranges");
  return losses;
}

void
LasValues::storeTransform(char* place) const
{
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    char* const numbers = place + 8 * axis;
    storeLasNumber(numbers, has_looked_ ? scale_ : kUsualScale);
    storeLasNumber(numbers + 24, offset_[axis]);
    char* const bounds = place + 48 + 16 * axis; // largest first
    storeLasNumber(bounds, has_looked_ ? highest_[axis] : 0.0);
    storeLasNumber(bounds + 8, has_looked_ ? lowest_[axis] : 0.0);
  }
}

} // namespace pcl6d::io
