// SPDX-License-Identifier: BSD-3-Clause
#include "facing_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl6d {

namespace {
/** Steeper, a surface is not seen well enough to speak of it. */
constexpr double kGrazing = 0.17; // cosine of 80 deg

/** Elements side by side on one surface differ in range by no more than so many of their
 * sizes, over the cosine. */
constexpr double kDepth = 2;

/** A picture of an object as the scanner sees it: on a plane across the sight to its
 * middle, in pixels of an element. */
class Picture {
public:
  Picture(const std::vector<FacingElement>& elements,
          const Eigen::Vector3d& middle,
          double element)
  : pixel_(element / std::max(middle.norm(), element))
  {
    axes_.row(2) = middle.normalized();
    axes_.row(0) = axes_.row(2).transpose().unitOrthogonal();
    axes_.row(1) = axes_.row(2).transpose().cross(axes_.row(0).transpose());
    for (const auto& e : elements)
      box_.extend(place(e));
    constexpr int kRim = 1;
    cols_ = box_.isEmpty() ? 0 : box_.sizes().x() + 1 + 2 * kRim;
    const int rows = box_.isEmpty() ? 0 : box_.sizes().y() + 1 + 2 * kRim;
    nearest_.assign(static_cast<std::size_t>(cols_) * static_cast<std::size_t>(rows),
                    std::numeric_limits<double>::infinity());
    for (const auto& e : elements)
      draw(e);
  }

  bool
  hides(const FacingElement& e, double margin) const
  {
    return e.range > nearest_[index(place(e))] + margin / e.cosine;
  }

private:
  Eigen::Vector2i
  place(const FacingElement& e) const
  {
    constexpr double kWidest =
        1000; // pixels off the middle, of what is beside the scanner
    const Eigen::Vector3d p = axes_ * e.point;
    const double depth = std::max(p.z(), 1e-3 * e.range) * pixel_;
    return (p.head<2>() / depth)
        .cwiseMin(kWidest)
        .cwiseMax(-kWidest)
        .array()
        .floor()
        .matrix()
        .cast<int>();
  }

  std::size_t
  index(const Eigen::Vector2i& place) const
  {
    const Eigen::Vector2i p = place - box_.min() + Eigen::Vector2i::Ones();
    return static_cast<std::size_t>(p.y()) * static_cast<std::size_t>(cols_) +
           static_cast<std::size_t>(p.x());
  }

  /** A pixel wider all around, so that elements close their gaps. */
  void
  draw(const FacingElement& e)
  {
    const Eigen::Vector2i middle = place(e);
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        double& nearest = nearest_[index(middle + Eigen::Vector2i(x, y))];
        nearest = std::min(nearest, e.range);
      }
  }

  double pixel_;
  Eigen::Matrix3d axes_;
  Eigen::AlignedBox2i box_;
  int cols_ = 0;
  std::vector<double> nearest_; // range by pixel
};
} // namespace

std::vector<FacingElement>
facingElements(const OrientedPoints& model,
               const Eigen::Isometry3d& T_scene_model,
               double element)
{
  std::vector<FacingElement> facing;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < model.size(); ++i) {
    const Eigen::Vector3d point = T_scene_model * model.points[i].cast<double>();
    const Eigen::Vector3d normal =
        T_scene_model.linear() * model.normals[i].cast<double>();
    const double range = point.norm();
    const double cosine = -normal.dot(point) / range;
    if (!(cosine > 0)) // the element is turned away, or at the scanner
      continue;
    facing.push_back({static_cast<std::uint32_t>(i), point, normal, range, cosine});
    middle += point;
  }
  if (facing.empty())
    return facing;
  const Picture picture(facing, middle / static_cast<double>(facing.size()), element);
  const auto isUnseen = [&](const FacingElement& e) {
    return e.cosine < kGrazing || picture.hides(e, kDepth * element);
  };
  facing.erase(std::remove_if(facing.begin(), facing.end(), isUnseen), facing.end());
  return facing;
}

} // namespace pcl6d
