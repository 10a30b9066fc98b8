// SPDX-License-Identifier: BSD-3-Clause
#include "scene/value_noise.h"

#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/simulation/terrain.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using namespace simulation;

double
TerrainOptions::numCells() const
{
  return ((high - low).array() / cell).ceil().prod();
}

void
TerrainOptions::validate() const
{
  require(low.allFinite(), "low", low.transpose(), "finite");
  require(high.allFinite() && (high.array() > low.array()).all(),
          "high",
          high.transpose(),
          "> low in x and y");
  require(cell > 0 && std::isfinite(cell), "cell", cell, "> 0");
  require(numCells() <= kMostCells,
          "cell",
          cell,
          "larger: the rectangle would have more than 2 million cells");
  require(std::isfinite(height), "height", height, "finite");
  require(slope.allFinite(), "slope", slope.transpose(), "finite");
  require(amplitude >= 0 && std::isfinite(amplitude), "amplitude", amplitude, ">= 0");
  require(wavelength > 0 && std::isfinite(wavelength), "wavelength", wavelength, "> 0");
}

Terrain::Terrain(const TerrainOptions& options) : options_(options)
{
  options.validate();
  const Eigen::Vector2d size = options.high - options.low;
  const Eigen::Vector2d cells = (size.array() / options.cell).ceil();
  step_ = size.array() / cells.array();
  columns_ = static_cast<std::size_t>(cells.x()) + 1;
  rows_ = static_cast<std::size_t>(cells.y()) + 1;
  heights_.reserve(columns_ * rows_);
  for (std::size_t row = 0; row < rows_; ++row)
    for (std::size_t column = 0; column < columns_; ++column) {
      const Eigen::Vector2d p =
          options.low + Eigen::Vector2d(static_cast<double>(column) * step_.x(),
                                        static_cast<double>(row) * step_.y());
      const Eigen::Vector3d wave(
          p.x() / options.wavelength, p.y() / options.wavelength, 0);
      heights_.push_back(options.height + options.slope.dot(p) +
                         options.amplitude * fractalNoise(wave, options.seed));
    }
}

double
Terrain::height(const Eigen::Vector2d& place) const
{
  const auto cellOf = [](double u, std::size_t count) {
    return std::min(static_cast<std::size_t>(u), count - 2);
  };
  const Eigen::Vector2d inside = place.cwiseMax(options_.low).cwiseMin(options_.high);
  const Eigen::Array2d u = (inside - options_.low).array() / step_.array();
  const std::size_t column = cellOf(u.x(), columns_);
  const std::size_t row = cellOf(u.y(), rows_);
  const double s = u.x() - static_cast<double>(column);
  const double t = u.y() - static_cast<double>(row);
  const double near = heights_[index(column, row)];
  const double far = heights_[index(column + 1, row + 1)];
  // The cell is cut from its near to its far corner.
  if (s >= t) {
    const double right = heights_[index(column + 1, row)];
    return near + s * (right - near) + t * (far - right);
  }
  const double left = heights_[index(column, row + 1)];
  return near + t * (left - near) + s * (far - left);
}

Eigen::Isometry3d
Terrain::poseOn(const Eigen::Vector2d& place, double yaw) const
{
  constexpr double kReach = 1; // [m] to measure the slope over
  const auto rise = [&](const Eigen::Vector2d& way) {
    return (height(place + way) - height(place - way)) / (2 * kReach);
  };
  const Eigen::Vector3d z =
      Eigen::Vector3d(-rise({kReach, 0}), -rise({0, kReach}), 1).normalized();
  const SinCos heading = portableSinCos(yaw);
  const Eigen::Vector2d ahead(heading.cos, heading.sin);
  Eigen::Vector3d x;
  x << ahead, -ahead.dot(z.head<2>()) / z.z();
  x.normalize();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << x, z.cross(x), z;
  pose.translation() << place, height(place);
  return pose;
}

void
Terrain::addTo(TriangleScene& scene, const Surface& material) const
{
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  const std::uint32_t surface = scene.addSurface(material);
  for (std::size_t row = 0; row < rows_; ++row)
    for (std::size_t column = 0; column < columns_; ++column)
      scene.vertices.emplace_back(
          options_.low.x() + static_cast<double>(column) * step_.x(),
          options_.low.y() + static_cast<double>(row) * step_.y(),
          heights_[index(column, row)]);
  const auto vertex = [&](std::size_t column, std::size_t row) {
    return first + static_cast<std::uint32_t>(index(column, row));
  };
  for (std::size_t row = 0; row + 1 < rows_; ++row)
    for (std::size_t column = 0; column + 1 < columns_; ++column)
      scene.addQuad({vertex(column, row),
                     vertex(column + 1, row),
                     vertex(column + 1, row + 1),
                     vertex(column, row + 1)},
                    surface);
}

} // namespace pcl6d
