// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/report/report.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl6d::app {

namespace {
constexpr double kWidth = 480, kMargin = 8; // [pixels]
constexpr std::size_t kMostDots = 2500;     // of a cloud

/** \return the two directions of largest extent of the points, as rows */
Eigen::Matrix<double, 2, 3>
planeOf(const Points& points, const Eigen::Vector3d& middle)
{
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const auto& p : points) {
    const Eigen::Vector3d d = p.cast<double>() - middle;
    spread += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  Eigen::Matrix<double, 2, 3> plane; // values ascend
  plane.row(0) = solver.eigenvectors().col(2).transpose();
  plane.row(1) = solver.eigenvectors().col(1).transpose();
  return plane;
}

/** \return evenly chosen points, flat */
std::vector<Eigen::Vector2d>
flat(const Points& points,
     const Eigen::Isometry3d& pose,
     const Eigen::Matrix<double, 2, 3>& plane)
{
  std::vector<Eigen::Vector2d> dots;
  const std::size_t stride = points.size() / kMostDots + 1;
  for (std::size_t i = 0; i < points.size(); i += stride)
    dots.emplace_back(plane * (pose * points[i].cast<double>()));
  return dots;
}

/** \return bounding box without the outermost hundredth on each side */
Eigen::AlignedBox2d
boxOf(std::vector<Eigen::Vector2d> dots)
{
  Eigen::AlignedBox2d box;
  Eigen::Vector2d low, high;
  for (int axis = 0; axis < 2; ++axis) {
    std::sort(dots.begin(), dots.end(), [axis](const auto& a, const auto& b) {
      return a[axis] < b[axis];
    });
    const std::size_t cut = dots.size() / 100;
    low[axis] = dots[cut][axis];
    high[axis] = dots[dots.size() - 1 - cut][axis];
  }
  box.extend(low);
  box.extend(high);
  return box;
}

std::string
pathOf(const std::vector<Eigen::Vector2d>& dots,
       const Eigen::AlignedBox2d& box,
       double scale,
       const char* colour)
{
  std::string path;
  for (const auto& dot : dots) {
    if (!box.contains(dot))
      continue;
    const Eigen::Vector2d p = scale * (dot - box.min());
    path += 'M' + std::to_string(std::lround(p.x() + kMargin)) + ' ' +
            std::to_string(std::lround(scale * box.sizes().y() - p.y() + kMargin)) +
            "h0";
  }
  return "<path d=\"" + path + "\" stroke=\"" + colour +
         "\" stroke-width=\"2\" stroke-linecap=\"round\" opacity=\"0.7\"/>";
}
} // namespace

std::string
svgOfPose(const DoctorPair& pair, const Eigen::Isometry3d& pose)
{
  if (pair.target_points.empty() || pair.source_points.empty())
    return {};
  const Eigen::Vector3d middle = pair.of_target.middle - pair.target.offset;
  const auto plane = planeOf(pair.target_points, middle);
  const auto target = flat(pair.target_points, Eigen::Isometry3d::Identity(), plane);
  const auto source = flat(pair.source_points, pose, plane);
  std::vector<Eigen::Vector2d> all = target;
  all.insert(all.end(), source.begin(), source.end());
  const Eigen::AlignedBox2d box = boxOf(all);
  const double size = std::max(box.sizes().maxCoeff(), 1e-30); // of one point
  const double scale = (kWidth - 2 * kMargin) / size;
  const auto side = [&](double length) {
    return std::to_string(std::lround(scale * length + 2 * kMargin));
  };
  return "<svg viewBox=\"0 0 " + side(box.sizes().x()) + ' ' + side(box.sizes().y()) +
         "\" width=\"" + side(box.sizes().x()) + "\" role=\"img\">" +
         pathOf(target, box, scale, "#2f6db5") + pathOf(source, box, scale, "#d1495b") +
         "</svg>";
}

} // namespace pcl6d::app
