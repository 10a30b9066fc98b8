// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/point_spread.h"
#include "views/map_splats.h"

#include <pcl6d/common/parallel.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::visualization {

namespace {
constexpr std::size_t kPointsPerBlock = 1U << 16U;

/** Counts points in the cells of a grid over nearly every point. */
class DensityGrid {
public:
  DensityGrid(const Points& points, const std::vector<std::size_t>& indices)
  {
    Eigen::AlignedBox3f box;
    const std::size_t step = indices.size() / 100000 + 1;
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<float> values;
      for (std::size_t k = 0; k < indices.size(); k += step)
        values.push_back(points[indices[k]][axis]);
      box.min()[axis] = quantile(values, 0.002);
      box.max()[axis] = quantile(std::move(values), 0.998);
    }
    constexpr float kCellsPerSide = 250;
    corner_ = box.min();
    cell_ = std::max(box.sizes().maxCoeff() / kCellsPerSide, 1e-3F);
    for (int axis = 0; axis < 3; ++axis)
      cells_[axis] = static_cast<int>(box.sizes()[axis] / cell_) + 1;
    counts_.assign(static_cast<std::size_t>(cells_[0]) *
                       static_cast<std::size_t>(cells_[1]) *
                       static_cast<std::size_t>(cells_[2]),
                   0);
    for (const auto i : indices)
      ++counts_[cellOf(points[i])];
  }

  /** \return the distance of neighbours [m], assuming the points of a cell lie on one
   * surface */
  float
  spacingAt(const Eigen::Vector3f& p) const
  {
    return cell_ / std::sqrt(static_cast<float>(counts_[cellOf(p)]));
  }

private:
  std::size_t
  cellOf(const Eigen::Vector3f& p) const
  {
    std::size_t place = 0;
    for (int axis = 2; axis >= 0; --axis) {
      const float along = std::clamp((p[axis] - corner_[axis]) / cell_,
                                     0.0F,
                                     static_cast<float>(cells_[axis] - 1));
      place = place * static_cast<std::size_t>(cells_[axis]) +
              static_cast<std::size_t>(along);
    }
    return place;
  }

  Eigen::Vector3f corner_;
  float cell_ = 1; // [m]
  std::array<int, 3> cells_{};
  std::vector<std::uint32_t> counts_;
};

/** Panoramas of a scan: a uniform size on the picture closes the gaps. */
double
panoramaDiameter(const Points& points,
                 const std::vector<std::size_t>& indices,
                 const Camera& camera,
                 const PictureBox& box)
{
  const Eigen::Isometry3d to_camera = camera.T_world_camera.inverse();
  std::vector<Eigen::Vector3f> pixels;
  for (const auto i : indices)
    if (const auto pixel = camera.project(to_camera * points[i].cast<double>()))
      if (box.contains(pixel->head<2>()))
        pixels.push_back(pixel->cast<float>());
  return 1.9 * pixelSpacing(pixels,
                            static_cast<int>(box.right) + 1,
                            static_cast<int>(box.bottom) + 1);
}

/** Brightness of a face from its slope. */
Colour
shaded(const Colour& colour, const Eigen::Vector3d& normal)
{
  const double light =
      0.65 + 0.35 * std::abs(normal.dot(Eigen::Vector3d(0.36, 0.48, 0.8)));
  Colour result{};
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = static_cast<std::uint8_t>(light * colour[i]);
  return result;
}
} // namespace

std::vector<float>
localSpacing(const Points& points, const std::vector<std::size_t>& indices)
{
  const DensityGrid grid(points, indices);
  std::vector<float> spacing(indices.size());
  parallelBlocks(indices.size(), kPointsPerBlock, 0, [&](const Block& block) {
    for (std::size_t k = block.begin; k < block.end; ++k)
      spacing[k] = grid.spacingAt(points[indices[k]]);
  });
  std::vector<float> sample;
  for (std::size_t k = 0; k < spacing.size(); k += spacing.size() / 100000 + 1)
    sample.push_back(spacing[k]);
  const float usual = quantile(std::move(sample), 0.5);
  for (auto& value : spacing)
    value = std::clamp(value, 0.5F * usual, 2.5F * usual);
  return spacing;
}

void
addSplats(const Points& points,
          const std::vector<std::size_t>& indices,
          const Camera& camera,
          const PictureBox& box,
          double size,
          SplatBuffer& buffer)
{
  const bool panorama = camera.projection == Projection::kPanorama;
  const auto fixed = static_cast<float>(
      panorama ? size * panoramaDiameter(points, indices, camera, box) : 0);
  const auto spacing = panorama ? std::vector<float>() : localSpacing(points, indices);
  const auto zoom = static_cast<float>(1.5 * size * camera.scale);
  const auto largest = static_cast<float>(0.02 * (box.right - box.left));
  const Eigen::Isometry3d to_camera = camera.T_world_camera.inverse();
  parallelBlocks(indices.size(), kPointsPerBlock, 0, [&](const Block& block) {
    for (std::size_t k = block.begin; k < block.end; ++k) {
      const auto pixel = camera.project(to_camera * points[indices[k]].cast<double>());
      if (!pixel)
        continue;
      const auto depth = static_cast<float>(pixel->z());
      const float diameter = panorama ? fixed : zoom * spacing[k] / depth;
      buffer.add(static_cast<float>(pixel->x()),
                 static_cast<float>(pixel->y()),
                 depth,
                 std::clamp(diameter, 1.0F, largest),
                 static_cast<std::uint32_t>(k));
    }
  });
}

void
addModels(const std::vector<MapViewScene::Model>& models,
          const Camera& camera,
          std::vector<Colour>& colours,
          SplatBuffer& buffer)
{
  const Eigen::Isometry3d to_camera = camera.T_world_camera.inverse();
  for (const auto& model : models)
    for (const auto& corners : model.mesh.triangles) {
      const Eigen::Vector3d a = to_camera * model.mesh.vertices.at(corners[0]);
      const Eigen::Vector3d u = to_camera * model.mesh.vertices.at(corners[1]) - a;
      const Eigen::Vector3d v = to_camera * model.mesh.vertices.at(corners[2]) - a;
      const double depth = std::max((a + (u + v) / 3).norm(), 0.1);
      const double longest = std::max({u.norm(), v.norm(), (u - v).norm()});
      // Samples lie less than a pixel apart; a near giant does not take for ever.
      const int steps = static_cast<int>(
          std::clamp(std::ceil(1.2 * longest * camera.scale / depth), 1.0, 2000.0));
      colours.push_back(shaded(
          model.colour, camera.T_world_camera.linear() * u.cross(v).normalized()));
      const auto colour = static_cast<std::uint32_t>(colours.size() - 1);
      for (int i = 0; i <= steps; ++i)
        for (int k = 0; k <= steps - i; ++k)
          if (const auto pixel = camera.project(a + u * i / steps + v * k / steps))
            buffer.add(static_cast<float>(pixel->x()),
                       static_cast<float>(pixel->y()),
                       static_cast<float>(pixel->z()),
                       1.5F,
                       colour);
    }
}

} // namespace pcl6d::visualization
