// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/object_localization/detection_views.h>

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>

namespace pcl6d {
namespace {
double
tangent(double angle)
{
  const SinCos s = portableSinCos(angle);
  return s.sin / s.cos;
}

ImageView
frontView(const DetectionViewOptions& o)
{
  ImageView view;
  view.left = o.width / 2;
  view.right = -view.left;
  view.top = o.top;
  view.bottom = o.bottom;
  view.cols = static_cast<int>(std::ceil(2 * tangent(view.left) / o.pixel));
  view.rows =
      static_cast<int>(std::ceil((tangent(o.top) - tangent(o.bottom)) / o.pixel));
  return view;
}

GrayImage
toGrayImage(const cv::Mat& mat)
{
  GrayImage image(mat.rows, mat.cols);
  std::copy(mat.begin<std::uint8_t>(), mat.end<std::uint8_t>(), image.pixels.begin());
  return image;
}
} // namespace

void
DetectionViewOptions::validate() const
{
  require(views >= 3 && views <= 64, "views", views, "in [3, 64]");
  require(width >= 2 * M_PI / views && width <= 2.4,
          "width",
          width,
          "from a view's share of the turn to 2.4 rad");
  require(top < 1.2, "top", top, "< 1.2 rad");
  require(bottom > -1.2 && bottom < top, "bottom", bottom, "> -1.2 rad and below top");
  require(pixel >= 1e-4 && pixel <= 0.1, "pixel", pixel, "in [1e-4, 0.1] rad");
  require(min_range > 0, "min_range", min_range, "> 0");
  require(max_range > min_range && std::isfinite(max_range),
          "max_range",
          max_range,
          "> min_range and finite");
  require(slice_depth >= 0.01, "slice_depth", slice_depth, ">= 0.01");
  // Each slice is a picture of each view; too many would exhaust memory.
  constexpr double kMostDepths = 5000;
  require(max_range <= kMostDepths * slice_depth,
          "max_range",
          max_range,
          "at most 5000 times slice_depth");
  require(max_gap > 0 && max_gap <= 1, "max_gap", max_gap, "in (0, 1] rad");
}

std::vector<DepthSlice>
depthSlices(const DetectionViewOptions& options)
{
  std::vector<DepthSlice> slices;
  const double step = options.slice_depth / 2;
  do {
    const double start = options.min_range + step * static_cast<double>(slices.size());
    slices.push_back({start, start + options.slice_depth});
  } while (slices.back().far_end < options.max_range);
  return slices;
}

DetectionViews::DetectionViews(const DetectionViewOptions& options) : options_(options)
{
  options.validate();
  views_ = viewsAround(frontView(options), options.views);
  slices_ = depthSlices(options);
}

RangeImage
DetectionViews::image(std::size_t view,
                      const Points& points,
                      const std::vector<float>& reflectance) const
{
  constexpr double kSameSurface = 0.2; // [m] between neighbouring samples
  require(view < views_.size(), "view", view, "< " + std::to_string(views_.size()));
  RangeImageOptions ranges;
  ranges.min_range = options_.min_range;
  ranges.max_range = options_.max_range + options_.slice_depth;
  ranges.num_threads = options_.num_threads;
  RangeImage image =
      RangeImage::project(points,
                          std::make_shared<PerspectiveProjection>(views_[view]),
                          ranges,
                          reflectance);
  const double gap = std::floor(options_.max_gap / options_.pixel + 0.5); // [px]
  fillGaps(image, {std::max(1, static_cast<int>(gap)), kSameSurface});
  return image;
}

std::size_t
DetectionViews::viewOf(const Eigen::Vector3d& point) const
{
  std::size_t nearest = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < views_.size(); ++i)
    if (const double ahead = views_[i].T_scan_view.linear().col(0).dot(point);
        ahead > most) {
      most = ahead;
      nearest = i;
    }
  return nearest;
}

DetectionViews::Place
DetectionViews::place(std::size_t view, const Eigen::Vector3d& point) const
{
  const ImageView& v = views_[view];
  const Eigen::Vector3d p = v.T_scan_view.inverse() * point;
  const double width = 2 * tangent(v.left), top = tangent(v.top);
  return {(width / 2 - p.y() / p.x()) / width * v.cols,
          (top - p.z() / p.x()) / (top - tangent(v.bottom)) * v.rows,
          p.x()};
}

double
DetectionViews::pixelsOf(double size, double depth) const
{
  const ImageView& v = views_.front();
  return size / depth / (tangent(v.top) - tangent(v.bottom)) * v.rows;
}

GrayImage
rangePicture(const RangeImage& image, const DepthSlice& slice)
{
  return toGrayImage(
      toGray8(image, ImageChannel::kRange, {slice.far_end, slice.near_end}));
}

GrayImage
reflectancePicture(const RangeImage& image)
{
  std::vector<float> values;
  for (const float value : image.reflectances())
    if (std::isfinite(value))
      values.push_back(value);
  if (values.empty())
    return GrayImage(image.rows(), image.cols());
  const auto white =
      values.begin() + static_cast<std::ptrdiff_t>(values.size() * 99 / 100);
  std::nth_element(values.begin(), white, values.end());
  const double bright = *white > 0 ? *white : 1;
  return toGrayImage(toGray8(image, ImageChannel::kReflectance, {0.0, bright}));
}

} // namespace pcl6d
