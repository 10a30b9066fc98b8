// SPDX-License-Identifier: BSD-3-Clause
#include "size_limits.h"

#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/scanner/range_projection.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using namespace scanner;

namespace {
constexpr double kRightAngle = M_PI / 2;
constexpr double kMostOffAxis = 89.5 * M_PI / 180; // where tan() is 115

double
tangent(double angle)
{
  const auto [s, c] = portableSinCos(angle);
  return s / c;
}

void
requireOffAxis(double angle, const char* name)
{
  require(std::abs(angle) <= kMostOffAxis, name, angle, "within 89.5 deg (1.562 rad)");
}
} // namespace

void
ImageView::validate() const
{
  requireImageSize(rows, cols);
  // A border may miss the full turn or the pole by the rounding of degrees.
  constexpr double kRounding = 1e-9;
  require(std::isfinite(left), "left", left, "finite");
  require(right < left, "right", right, "< left");
  require(left - right <= 2 * M_PI + kRounding,
          "left - right",
          left - right,
          "at most a full turn");
  require(std::abs(left) <= 2 * M_PI + kRounding, "left", left, "within a full turn");
  require(top <= kRightAngle + kRounding, "top", top, "at most pi / 2");
  require(bottom < top, "bottom", bottom, "< top");
  require(bottom >= -kRightAngle - kRounding, "bottom", bottom, "at least -pi / 2");
  require(isRigid(T_scan_view, 1e-9), "T_scan_view", T_scan_view.matrix(), "rigid");
}

std::vector<ImageView>
viewsAround(const ImageView& view, int count)
{
  require(count >= 1 && count <= 10000, "count", count, "in [1, 10000]");
  std::vector<ImageView> views(static_cast<std::size_t>(count), view);
  for (int i = 0; i < count; ++i) {
    const auto [s, c] = portableSinCos(2 * M_PI * i / count);
    Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
    turn.linear() << c, -s, 0, s, c, 0, 0, 0, 1;
    views[static_cast<std::size_t>(i)].T_scan_view = turn * view.T_scan_view;
  }
  return views;
}

ViewProjection::ViewProjection(const ImageView& view) : view_(view)
{
  view_.validate();
  T_view_scan_ = view_.T_scan_view.inverse();
}

void
ViewProjection::setBorders(const Eigen::Vector2d& left_top,
                           const Eigen::Vector2d& right_bottom)
{
  left_top_ = left_top;
  size_ = left_top - right_bottom;
}

std::optional<PixelRange>
ViewProjection::project(const Eigen::Vector3d& point) const
{
  const Eigen::Vector3d p = T_view_scan_ * point;
  const double range = p.norm();
  if (!(range > 0 && std::isfinite(range)))
    return std::nullopt;
  const auto at = place(p);
  if (!at)
    return std::nullopt;
  const Eigen::Array2d share = (left_top_ - *at).array() / size_.array();
  if (!(share >= 0).all() || !(share <= 1).all())
    return std::nullopt;
  const int col = std::min(static_cast<int>(share.x() * cols()), cols() - 1);
  const int row = std::min(static_cast<int>(share.y() * rows()), rows() - 1);
  return PixelRange{{row, col}, range};
}

Ray
ViewProjection::ray(const Pixel& pixel) const
{
  const Eigen::Array2d share((pixel.col + 0.5) / cols(), (pixel.row + 0.5) / rows());
  const Eigen::Vector2d at = left_top_.array() - share * size_.array();
  return {view_.T_scan_view.translation(),
          view_.T_scan_view.linear() * towards(at).normalized()};
}

namespace {
/** \return the azimuth, by full turns brought to (left - 2 pi, left] */
double
azimuthBelow(double left, const Eigen::Vector3d& point)
{
  const double azimuth = portableAtan2(point.y(), point.x());
  return azimuth - 2 * M_PI * std::ceil((azimuth - left) / (2 * M_PI));
}
} // namespace

SphericalProjection::SphericalProjection(const ImageView& view) : ViewProjection(view)
{
  setBorders({view.left, view.top}, {view.right, view.bottom});
}

std::optional<Eigen::Vector2d>
SphericalProjection::place(const Eigen::Vector3d& point) const
{
  return Eigen::Vector2d(azimuthBelow(view_.left, point),
                         portableAtan2(point.z(), point.head<2>().norm()));
}

Eigen::Vector3d
SphericalProjection::towards(const Eigen::Vector2d& place) const
{
  const auto [sa, ca] = portableSinCos(place.x());
  const auto [se, ce] = portableSinCos(place.y());
  return {ce * ca, ce * sa, se};
}

CylindricalProjection::CylindricalProjection(const ImageView& view)
: ViewProjection(view)
{
  requireOffAxis(view.top, "top");
  requireOffAxis(view.bottom, "bottom");
  setBorders({view.left, tangent(view.top)}, {view.right, tangent(view.bottom)});
}

std::optional<Eigen::Vector2d>
CylindricalProjection::place(const Eigen::Vector3d& point) const
{
  const double radius = point.head<2>().norm();
  if (!(radius > 0))
    return std::nullopt;
  return Eigen::Vector2d(azimuthBelow(view_.left, point), point.z() / radius);
}

Eigen::Vector3d
CylindricalProjection::towards(const Eigen::Vector2d& place) const
{
  const auto [s, c] = portableSinCos(place.x());
  return {c, s, place.y()};
}

PerspectiveProjection::PerspectiveProjection(const ImageView& view)
: ViewProjection(view)
{
  requireOffAxis(view.left, "left");
  requireOffAxis(view.right, "right");
  requireOffAxis(view.top, "top");
  requireOffAxis(view.bottom, "bottom");
  setBorders({tangent(view.left), tangent(view.top)},
             {tangent(view.right), tangent(view.bottom)});
}

std::optional<Eigen::Vector2d>
PerspectiveProjection::place(const Eigen::Vector3d& point) const
{
  if (!(point.x() > 0))
    return std::nullopt;
  return Eigen::Vector2d(point.y() / point.x(), point.z() / point.x());
}

Eigen::Vector3d
PerspectiveProjection::towards(const Eigen::Vector2d& place) const
{
  return {1, place.x(), place.y()};
}

} // namespace pcl6d
