// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/colours.h"
#include "drawing/picture_size.h"
#include "drawing/pixel_scene.h"
#include "drawing/point_spread.h"
#include "drawing/theme.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/visualization/plane_view.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using namespace visualization;

namespace {
constexpr Colour kUnassigned{95, 98, 105};
constexpr double kMargin = 30; // [px]

void
checkScene(const PlaneViewScene& scene)
{
  if (scene.plane_of.size() != scene.points.size())
    throw BadArgument(std::to_string(scene.plane_of.size()) + " planes of " +
                      std::to_string(scene.points.size()) + " points");
  if (scene.seen_from.size() != scene.planes.size())
    throw BadArgument(std::to_string(scene.seen_from.size()) + " sides seen of " +
                      std::to_string(scene.planes.size()) + " planes");
  for (const auto id : scene.plane_of)
    require(id <= scene.planes.size(), "plane_of", id, "at most the number of planes");
}

/** Horizontal direction of the largest extent of the points; in [0, pi). */
double
longestDirection(const Points& points, const std::vector<std::size_t>& shown)
{
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto i : shown)
    mean += points[i].head<2>().cast<double>() / static_cast<double>(shown.size());
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const auto i : shown) {
    const Eigen::Vector2d d = points[i].head<2>().cast<double>() - mean;
    scatter += d * d.transpose();
  }
  const double angle =
      0.5 * std::atan2(2 * scatter(0, 1), scatter(0, 0) - scatter(1, 1));
  return angle < 0 ? angle + M_PI : angle;
}

Eigen::Vector3d
towardsCamera(double azimuth, double elevation)
{
  return {std::cos(elevation) * std::cos(azimuth),
          std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

/** The azimuth with the largest visible area of planes; without planes, across the
 * longest extent. */
double
bestAzimuth(const PlaneViewScene& scene,
            const std::vector<std::size_t>& shown,
            double elevation)
{
  constexpr int kTried = 48;
  double best = longestDirection(scene.points, shown) - M_PI / 3;
  double most = 0;
  for (int i = 0; i < kTried; ++i) {
    const double azimuth = 2 * M_PI * i / kTried;
    const Eigen::Vector3d to_camera = towardsCamera(azimuth, elevation);
    double seen = 0;
    for (std::size_t k = 0; k < scene.planes.size(); ++k)
      seen += scene.planes[k].area * std::max(0.0, scene.seen_from[k].dot(to_camera));
    if (seen > most) {
      most = seen;
      best = azimuth;
    }
  }
  return best;
}

void
aim(const PlaneViewOptions& options,
    const PlaneViewScene& scene,
    const std::vector<std::size_t>& shown,
    PlaneViewLayout& layout)
{
  const double azimuth =
      options.azimuth.value_or(bestAzimuth(scene, shown, options.elevation));
  layout.to_camera = towardsCamera(azimuth, options.elevation);
  layout.right = Eigen::Vector3d(-std::sin(azimuth), std::cos(azimuth), 0);
  layout.up = layout.to_camera.cross(layout.right);
  for (const auto& side : scene.seen_from)
    layout.hidden.push_back(side.dot(layout.to_camera) < 0);
}

/** The range of values without isolated outliers. */
std::pair<double, double>
extentOf(std::vector<double> values)
{
  const auto at = [&](double share) {
    const auto place =
        static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + place, values.end());
    return values[static_cast<std::size_t>(place)];
  };
  return {at(0.0005), at(0.9995)};
}

void
zoom(const Points& points,
     const std::vector<std::size_t>& shown,
     PlaneViewLayout& layout)
{
  std::vector<double> across, upwards;
  for (const auto i : shown) {
    across.push_back(layout.right.dot(points[i].cast<double>()));
    upwards.push_back(layout.up.dot(points[i].cast<double>()));
  }
  const auto [left, right] = extentOf(std::move(across));
  const auto [bottom, top] = extentOf(std::move(upwards));
  layout.centre = {0.5 * (left + right), 0.5 * (bottom + top)};
  layout.metres_per_pixel = std::max({(right - left) / (layout.width - 2 * kMargin),
                                      (top - bottom) / (layout.height - 4 * kMargin),
                                      1e-6});
}

/** Adds the points, near points over far points. \return number of points on the picture */
std::size_t
addPoints(const PlaneViewScene& scene,
          const std::vector<std::size_t>& shown,
          const PlaneViewLayout& layout,
          PixelScene& picture)
{
  std::vector<double> depths;
  for (const auto i : shown)
    depths.push_back(layout.to_camera.dot(scene.points[i].cast<double>()));
  const auto [far, near] = std::minmax_element(depths.begin(), depths.end());
  const double span = std::max(*near - *far, 1e-9);
  std::vector<Eigen::Vector3f> pixels;
  std::vector<Colour> colours;
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const std::size_t i = shown[k];
    const Eigen::Vector2d pixel = layout.toPixel(scene.points[i].cast<double>());
    if (!(pixel.x() >= 0 && pixel.x() <= layout.width && pixel.y() >= 0 &&
          pixel.y() <= layout.height))
      continue;
    pixels.push_back(
        Eigen::Vector3d(pixel.x(), pixel.y(), (depths[k] - *far) / span).cast<float>());
    const auto plane = scene.plane_of[i];
    colours.push_back(plane == 0 ? kUnassigned : distinctColour(plane - 1));
  }
  const double spacing = pixelSpacing(pixels, layout.width, layout.height);
  picture.addPoints(pixels, colours, std::clamp(1.4 * spacing, 1.5, 6.0));
  return pixels.size();
}

/** Hull, number and label of a visible plane. */
void
addPlane(const Plane& plane,
         std::size_t number,
         const PlaneViewLayout& layout,
         PixelScene& picture)
{
  if (plane.hull.empty())
    return;
  std::vector<Eigen::Vector2d> ring;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  Eigen::AlignedBox2d box;
  for (const auto& corner : plane.hull) {
    ring.push_back(layout.toPixel(corner));
    middle += ring.back() / static_cast<double>(plane.hull.size());
    box.extend(ring.back());
  }
  ring.push_back(ring.front());
  picture.addLine(ring, {distinctColour(number - 1), 2, 2});
  constexpr double kSmallest = 45; // [px] room for the text
  if (box.sizes().x() < kSmallest || box.sizes().y() < kSmallest / 2)
    return;
  const std::string name =
      std::to_string(number) + (plane.label == "none" ? "" : " " + plane.label);
  const Eigen::Vector2d shadow(1.5, 1.5); // for legibility on every colour
  picture.addText(middle + shadow, name, PixelScene::Align::kCentre, {{0, 0, 0}, 16});
  picture.addText(middle, name, PixelScene::Align::kCentre, {{255, 255, 255}, 16});
}
} // namespace

void
PlaneViewOptions::validate() const
{
  requirePictureSize("width", width);
  requirePictureSize("height", height);
  require(!azimuth || std::isfinite(*azimuth), "azimuth", *azimuth, "finite");
  require(
      elevation > 0 && elevation < M_PI / 2, "elevation", elevation, "in (0, pi/2)");
  require(max_points > 0, "max_points", max_points, "> 0");
}

PlaneView::PlaneView(const PlaneViewOptions& options) : options_(options)
{
  options_.validate();
}

PlaneViewLayout
PlaneView::draw(const PlaneViewScene& scene, Image& image) const
{
  checkScene(scene);
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < scene.points.size(); ++i)
    if (canBeDrawn(scene.points[i]))
      shown.push_back(i);
  require(!shown.empty(), "number of finite points", 0, "> 0");
  PlaneViewLayout layout;
  layout.width = options_.width;
  layout.height = options_.height;
  aim(options_, scene, shown, layout);
  const auto isHidden = [&](std::size_t i) {
    return scene.plane_of[i] != 0 && layout.hidden[scene.plane_of[i] - 1];
  };
  zoom(scene.points, shown, layout);
  shown.erase(std::remove_if(shown.begin(), shown.end(), isHidden), shown.end());
  const Theme theme = themeOf(options_.background);
  PixelScene picture(layout.width, layout.height, theme.background);
  if (!shown.empty())
    layout.points_drawn =
        addPoints(scene, thinned(shown, options_.max_points), layout, picture);
  for (std::size_t k = 0; k < scene.planes.size(); ++k)
    if (!layout.hidden[k])
      addPlane(scene.planes[k], k + 1, layout, picture);
  if (!options_.title.empty())
    picture.addText(
        {kMargin, kMargin}, options_.title, PixelScene::Align::kLeft, {theme.text, 20});
  image = picture.draw(options_.transparent);
  return layout;
}

PlaneViewLayout
PlaneView::write(const std::filesystem::path& path, const PlaneViewScene& scene) const
{
  Image image;
  PlaneViewLayout layout = draw(scene, image);
  writePng(path, image);
  return layout;
}

} // namespace pcl6d
