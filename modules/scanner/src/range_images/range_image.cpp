// SPDX-License-Identifier: BSD-3-Clause
#include "size_limits.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/scanner/range_image.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using namespace scanner;

namespace {
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

void
requireInput(const Points& points,
             const RangeProjection* projection,
             const RangeImageOptions& options,
             const std::vector<float>& reflectance)
{
  constexpr std::size_t kMostPoints = std::numeric_limits<std::int32_t>::max();
  if (!projection)
    throw BadArgument("projection = null, but must be given");
  requireImageSize(projection->rows(), projection->cols());
  options.validate();
  require(points.size() <= kMostPoints, "points", points.size(), "below 2^31");
  require(reflectance.empty() || reflectance.size() == points.size(),
          "reflectances",
          reflectance.size(),
          "empty or the number of points (" + std::to_string(points.size()) + ")");
}

/** \brief Interpolated value of a pixel from a gap along one row or column. */
struct Filling {
  int length = std::numeric_limits<int>::max(); ///< [px] of the gap
  float range = 0;
  float reflectance = 0;
};

/** \brief A row or a column of an image. */
struct Line {
  Pixel start;
  Pixel step;
  int length;

  Pixel
  at(int i) const
  {
    return {start.row + i * step.row, start.col + i * step.col};
  }
};

class GapFiller {
public:
  GapFiller(RangeImage& image, const GapOptions& options)
  : image_(image), options_(options), fillings_(image.ranges().size())
  {}

  std::size_t
  fill()
  {
    for (int row = 0; row < image_.rows(); ++row)
      findGaps({{row, 0}, {0, 1}, image_.cols()});
    for (int col = 0; col < image_.cols(); ++col)
      findGaps({{0, col}, {1, 0}, image_.rows()});
    std::size_t filled = 0;
    for (int row = 0; row < image_.rows(); ++row)
      for (int col = 0; col < image_.cols(); ++col) {
        const Filling& filling = of({row, col});
        if (filling.length > options_.max_gap)
          continue;
        image_.interpolate({row, col}, filling.range, filling.reflectance);
        ++filled;
      }
    return filled;
  }

private:
  Filling&
  of(const Pixel& pixel)
  {
    return fillings_[static_cast<std::size_t>(pixel.row) *
                         static_cast<std::size_t>(image_.cols()) +
                     static_cast<std::size_t>(pixel.col)];
  }

  void
  findGaps(const Line& line)
  {
    int before = -1; // the last pixel with a value
    for (int i = 0; i < line.length; ++i) {
      if (std::isnan(image_.range(line.at(i))))
        continue;
      if (before >= 0 && i - before > 1)
        spanGap(line, before, i);
      before = i;
    }
  }

  void
  spanGap(const Line& line, int before, int after)
  {
    const int length = after - before - 1;
    const Pixel a = line.at(before), b = line.at(after);
    const float jump = image_.range(b) - image_.range(a);
    if (length > options_.max_gap || std::abs(jump) > options_.max_jump)
      return;
    const float contrast = image_.reflectance(b) - image_.reflectance(a);
    for (int i = before + 1; i < after; ++i) {
      Filling& filling = of(line.at(i));
      if (length >= filling.length)
        continue;
      const float share =
          static_cast<float>(i - before) / static_cast<float>(length + 1);
      filling = {length,
                 image_.range(a) + share * jump,
                 image_.reflectance(a) + share * contrast};
    }
  }

  RangeImage& image_;
  const GapOptions& options_;
  std::vector<Filling> fillings_;
};
} // namespace

void
RangeImageOptions::validate() const
{
  require(min_range >= 0 && std::isfinite(min_range), "min_range", min_range, ">= 0");
  require(max_range > min_range, "max_range", max_range, "> min_range");
}

RangeImage
RangeImage::project(const Points& points,
                    std::shared_ptr<const RangeProjection> projection,
                    const RangeImageOptions& options,
                    const std::vector<float>& reflectance)
{
  constexpr std::size_t kBlock = 4096;
  requireInput(points, projection.get(), options, reflectance);
  std::vector<Landing> landings(points.size());
  const auto land = [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const auto seen = projection->project(points[i].cast<double>());
      if (seen && seen->range >= options.min_range && seen->range <= options.max_range)
        landings[i] = {std::int64_t{seen->pixel.row} * projection->cols() +
                           seen->pixel.col,
                       static_cast<float>(seen->range)};
    }
  };
  parallelBlocks(points.size(), kBlock, options.num_threads, land);
  return {std::move(projection), landings, reflectance};
}

RangeImage
RangeImage::inOrder(const Points& points,
                    std::shared_ptr<const RangeProjection> projection,
                    const RangeImageOptions& options,
                    const std::vector<float>& reflectance)
{
  requireInput(points, projection.get(), options, reflectance);
  const auto cols = static_cast<std::size_t>(projection->cols());
  const std::size_t num_pixels = static_cast<std::size_t>(projection->rows()) * cols;
  require(points.size() == num_pixels,
          "points",
          points.size(),
          "one per pixel (" + std::to_string(num_pixels) + ")");
  std::vector<Landing> landings(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Ray ray =
        projection->ray({static_cast<int>(i / cols), static_cast<int>(i % cols)});
    const double range = (points[i].cast<double>() - ray.origin).dot(ray.direction);
    if (range > 0 && range >= options.min_range && range <= options.max_range)
      landings[i] = {static_cast<std::int64_t>(i), static_cast<float>(range)};
  }
  return {std::move(projection), landings, reflectance};
}

RangeImage::RangeImage(std::shared_ptr<const RangeProjection> projection,
                       const std::vector<Landing>& landings,
                       const std::vector<float>& reflectance)
: projection_(std::move(projection))
{
  const std::size_t num_pixels =
      static_cast<std::size_t>(rows()) * static_cast<std::size_t>(cols());
  range_.assign(num_pixels, kNone);
  reflectance_.assign(num_pixels, kNone);
  // Counting sort by pixel; points of a pixel stay in the order of their index.
  first_.assign(num_pixels + 1, 0);
  for (const auto& landing : landings)
    if (landing.pixel >= 0)
      ++first_[static_cast<std::size_t>(landing.pixel) + 1];
  for (std::size_t i = 0; i < num_pixels; ++i)
    first_[i + 1] += first_[i];
  points_.resize(first_.back());
  pixel_of_.resize(landings.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < landings.size(); ++i) {
    pixel_of_[i] = static_cast<std::int32_t>(landings[i].pixel);
    if (landings[i].pixel >= 0)
      points_[next[static_cast<std::size_t>(landings[i].pixel)]++] =
          static_cast<std::uint32_t>(i);
  }
  for (std::size_t pixel = 0; pixel < num_pixels; ++pixel) {
    if (first_[pixel] == first_[pixel + 1])
      continue;
    const auto nearest = points_.begin() + first_[pixel];
    std::stable_sort(nearest, points_.begin() + first_[pixel + 1], [&](auto a, auto b) {
      return landings[a].range < landings[b].range;
    });
    range_[pixel] = landings[*nearest].range;
    if (!reflectance.empty())
      reflectance_[pixel] = reflectance[*nearest];
  }
}

std::optional<std::size_t>
RangeImage::pointAt(const Pixel& pixel) const
{
  const std::size_t i = at(pixel);
  if (first_[i] == first_[i + 1])
    return std::nullopt;
  return points_[first_[i]];
}

std::vector<std::size_t>
RangeImage::pointsAt(const Pixel& pixel) const
{
  return pointsIn({pixel, pixel});
}

std::vector<std::size_t>
RangeImage::pointsIn(const PixelWindow& box) const
{
  std::vector<std::size_t> all;
  const int first_col = std::max(box.first.col, 0);
  const int last_col = std::min(box.last.col, cols() - 1);
  if (first_col > last_col)
    return all;
  for (int row = std::max(box.first.row, 0); row <= std::min(box.last.row, rows() - 1);
       ++row)
    all.insert(all.end(),
               points_.begin() + first_[at({row, first_col})],
               points_.begin() + first_[at({row, last_col}) + 1]);
  return all;
}

std::optional<Pixel>
RangeImage::pixelOf(std::size_t point) const
{
  require(point < pixel_of_.size(),
          "point",
          point,
          "below " + std::to_string(pixel_of_.size()));
  const std::int32_t pixel = pixel_of_[point];
  if (pixel < 0)
    return std::nullopt;
  return Pixel{pixel / cols(), pixel % cols()};
}

Eigen::Vector3d
RangeImage::position(const Pixel& pixel) const
{
  const Ray ray = projection_->ray(pixel);
  return ray.origin + double{range(pixel)} * ray.direction;
}

void
RangeImage::interpolate(const Pixel& pixel, float range, float reflectance)
{
  if (pointAt(pixel))
    throw BadArgument("pixel (" + std::to_string(pixel.row) + ", " +
                      std::to_string(pixel.col) + ") has points, but must be empty");
  range_[at(pixel)] = range;
  reflectance_[at(pixel)] = reflectance;
}

pcl::PointCloud<pcl::PointXYZI>
toPointCloud(const RangeImage& image)
{
  pcl::PointCloud<pcl::PointXYZI> cloud(static_cast<std::uint32_t>(image.cols()),
                                        static_cast<std::uint32_t>(image.rows()));
  cloud.is_dense = true;
  auto point = cloud.begin();
  for (int row = 0; row < image.rows(); ++row)
    for (int col = 0; col < image.cols(); ++col, ++point) {
      point->getVector3fMap() = image.position({row, col}).cast<float>();
      const float reflectance = image.reflectance({row, col});
      point->intensity = std::isfinite(reflectance) ? reflectance : 0;
      cloud.is_dense = cloud.is_dense && std::isfinite(point->x);
    }
  return cloud;
}

void
GapOptions::validate() const
{
  require(max_gap >= 1, "max_gap", max_gap, ">= 1");
  require(max_jump >= 0, "max_jump", max_jump, ">= 0");
}

std::size_t
fillGaps(RangeImage& image, const GapOptions& options)
{
  options.validate();
  std::size_t filled = 0;
  while (const std::size_t more = GapFiller(image, options).fill())
    filled += more;
  return filled;
}

} // namespace pcl6d
