// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/scanner/range_image.h>

#include <cmath>

namespace pcl6d {
namespace {
/** \brief What a gap along one row or column would put into a pixel. */
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
    int before = -1; // the last pixel that is not empty
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
