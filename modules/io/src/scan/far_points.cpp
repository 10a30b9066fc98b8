// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/number_range.h>
#include <pcl6d/common/require.h>
#include <pcl6d/io/far_points.h>
#include <pcl6d/io/vector_field.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <vector>

namespace pcl6d {

namespace {
constexpr double kFarthest = 10e3;   // [m] float resolves a millimetre up to here
constexpr double kFar = 500;         // [m] few scanners on the ground measure farther
constexpr double kNarrow = 1.0 / 16; // radius by distance: half of the 14.5 degrees of
                                     // the narrowest scanners, as a safety margin

const std::array<std::string, 3> kPlace = {"x", "y", "z"};
const std::array<std::string, 3> kNormal = {"normal_x", "normal_y", "normal_z"};

std::size_t
pointsIn(const pcl::PCLPointCloud2& cloud)
{
  return std::size_t{cloud.width} * cloud.height;
}

/** \return every n-th measured point, at most kMost points */
std::vector<Eigen::Vector3d>
sampleOf(const pcl::PCLPointCloud2& cloud, const VectorField& place)
{
  constexpr std::size_t kMost = 10000;
  const std::size_t step = pointsIn(cloud) / kMost + 1;
  std::vector<Eigen::Vector3d> sample;
  for (std::size_t i = 0; i < pointsIn(cloud); i += step) {
    const Eigen::Vector3d p = place.read(&cloud.data[i * cloud.point_step]);
    if (isPlace(p) && !p.isZero(0))
      sample.push_back(p);
  }
  return sample;
}

template <typename Value>
double
quantileOf(const std::vector<Eigen::Vector3d>& points, double share, Value&& value)
{
  std::vector<double> values;
  values.reserve(points.size());
  for (const auto& p : points)
    values.push_back(value(p));
  const auto place =
      values.begin() +
      static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/** \return the distance of neighbouring numbers in the type of the coordinates */
double
stepAt(double coordinate, const pcl::PCLPointCloud2& cloud)
{
  for (const auto& field : cloud.fields)
    if (field.name == kPlace[0] && field.datatype == pcl::PCLPointField::FLOAT64) {
      const double size = std::abs(coordinate);
      return std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
    }
  const auto size = static_cast<float>(std::abs(coordinate));
  return static_cast<double>(
             std::nextafter(size, std::numeric_limits<float>::infinity())) -
         static_cast<double>(size);
}
} // namespace

bool
PointsPlace::isFarFrom(const Eigen::Vector3d& place) const
{
  const double distance = (middle - place).norm();
  return distance > kFarthest || (distance > kFar && radius < kNarrow * distance);
}

std::optional<PointsPlace>
placeOf(const pcl::PCLPointCloud2& cloud)
{
  const VectorField coordinates(cloud.fields, kPlace);
  if (!coordinates)
    return {};
  const std::vector<Eigen::Vector3d> sample = sampleOf(cloud, coordinates);
  if (sample.empty())
    return {};
  PointsPlace place;
  for (int axis = 0; axis < 3; ++axis)
    place.middle[axis] =
        quantileOf(sample, 0.5, [&](const auto& p) { return p[axis]; });
  place.radius =
      quantileOf(sample, 0.9, [&](const auto& p) { return (p - place.middle).norm(); });
  place.step = stepAt(place.middle.cwiseAbs().maxCoeff(), cloud);
  return place;
}

Eigen::Vector3d
offsetOfFar(const pcl::PCLPointCloud2& cloud)
{
  const auto place = placeOf(cloud);
  return place && place->isFarFrom(Eigen::Vector3d::Zero())
             ? Eigen::Vector3d(place->middle.array().round())
             : Eigen::Vector3d::Zero();
}

void
moveCloud(const Eigen::Isometry3d& motion, pcl::PCLPointCloud2& cloud)
{
  const VectorField place(cloud.fields, kPlace);
  const VectorField normal(cloud.fields, kNormal);
  require(static_cast<bool>(place), "fields", "others", "x, y, z of floating point");
  for (std::size_t i = 0; i < pointsIn(cloud); ++i) {
    std::uint8_t* const point = &cloud.data[i * cloud.point_step];
    const Eigen::Vector3d p = place.read(point);
    place.write(p.isZero(0) ? Eigen::Vector3d::Constant(
                                  std::numeric_limits<double>::quiet_NaN())
                            : Eigen::Vector3d(motion * p),
                point);
    if (normal)
      normal.write(motion.linear() * normal.read(point), point);
  }
  cloud.is_dense = false;
}

std::string
describeFar(const PointsPlace& place)
{
  std::ostringstream words;
  words << std::fixed << std::setprecision(1) << "points lie "
        << place.middle.norm() / 1000 << " km from the origin of their coordinates";
  if (place.step >= 1e-3)
    words << ", where float has steps of " << std::setprecision(3) << place.step
          << " m: digits in between are lost";
  return words.str();
}

std::string
describeMove(const Eigen::Vector3d& offset)
{
  std::string words = ": moved by (";
  for (int axis = 0; axis < 3; ++axis)
    words += (axis > 0 ? ", " : "") + std::to_string(-std::llround(offset[axis]));
  return words + ") m";
}

} // namespace pcl6d
