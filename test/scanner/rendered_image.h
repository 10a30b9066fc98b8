// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/random.h>
#include <pcl6d/scanner/pinhole_camera.h>
#include <pcl6d/simulation/ray_caster.h>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>

namespace pcl6d::test {

/** \return a random number in [0, 1) that belongs to a cell of a grid */
inline double
cellNoise(const Eigen::Array2i& cell, int octave)
{
  std::uint64_t key = mixBits(static_cast<std::uint64_t>(octave));
  for (int axis = 0; axis < 2; ++axis)
    key = mixBits(key ^
                  static_cast<std::uint64_t>(static_cast<std::int64_t>(cell[axis])));
  return static_cast<double>(key >> 11) * 0x1.0p-53;
}

/** \return a random texture in [0, 1] that looks alike from near and from far: smooth
 * noise of cells of 5 mm, 1 cm, 2 cm .. 64 cm, all of one contrast, the same for all z
 * \param[in] pixel [m] finer cells are left out, as they would only alias */
inline double
texture(const Eigen::Vector3d& p, double pixel)
{
  constexpr int kOctaves = 8;
  double sum = 0;
  for (int octave = 0; octave < kOctaves; ++octave) {
    const double cell = 0.005 * (1 << octave);
    if (cell < pixel)
      continue;
    const Eigen::Array2d q = p.head<2>().array() / cell;
    const Eigen::Array2d low = q.floor();
    const Eigen::Array2d share = (q - low).square() * (3 - 2 * (q - low));
    for (int corner = 0; corner < 4; ++corner) {
      const Eigen::Array2i offset(corner & 1, corner >> 1);
      const Eigen::Array2d weight = (offset == 1).select(share, 1 - share);
      sum += weight.prod() * (cellNoise(low.cast<int>() + offset, octave) - 0.5);
    }
  }
  return std::clamp(0.5 + 0.6 * sum / std::sqrt(kOctaves), 0.0, 1.0);
}

/** \brief The picture that a camera takes of a textured scene.
 * \param[in] T_scene_camera pose of the camera, z forward
 * \param[in] noise standard deviation of a grey value, of 255
 * \return CV_8UC1; each pixel is the mean of 2 x 2 rays; black where nothing is */
inline cv::Mat
render(const RayCaster& scene,
       const PinholeCamera& camera,
       const Eigen::Isometry3d& T_scene_camera,
       double noise,
       std::uint64_t seed)
{
  constexpr int kRays = 2;
  const CameraIntrinsics& lens = camera.intrinsics();
  cv::Mat image(lens.height, lens.width, CV_8UC1, cv::Scalar(0));
  parallelFor(static_cast<std::size_t>(lens.height), 0, [&](std::size_t index) {
    const int row = static_cast<int>(index);
    Random random(mixBits(seed) ^ index);
    for (int col = 0; col < lens.width; ++col) {
      double sum = 0;
      for (int i = 0; i < kRays * kRays; ++i) {
        const auto xy = camera.undistort({col + (i % kRays + 0.5) / kRays - 0.5,
                                          row + (i / kRays + 0.5) / kRays - 0.5});
        if (!xy)
          continue;
        const Ray ray{T_scene_camera.translation(),
                      T_scene_camera.linear() * xy->homogeneous().normalized()};
        if (const auto hit = scene.cast(ray))
          sum += texture(ray.origin + hit->range * ray.direction, hit->range / lens.fx);
      }
      const double gray = 255 * sum / (kRays * kRays) + noise * random.normal();
      image.at<std::uint8_t>(row, col) =
          static_cast<std::uint8_t>(std::clamp(std::round(gray), 0.0, 255.0));
    }
  });
  return image;
}

} // namespace pcl6d::test
