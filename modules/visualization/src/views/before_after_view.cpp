// SPDX-License-Identifier: BSD-3-Clause
#include "views/top_view_area.h"

#include <pcl6d/common/require.h>
#include <pcl6d/visualization/before_after_view.h>

#include <algorithm>

namespace pcl6d {
using namespace visualization;

namespace {
void
paste(const Image& part, std::size_t left, Image& image)
{
  const auto columns = static_cast<std::size_t>(part.width);
  const auto all_columns = static_cast<std::size_t>(image.width);
  for (std::size_t row = 0; row < static_cast<std::size_t>(part.height); ++row) {
    std::copy_n(&part.rgb[3 * row * columns],
                3 * columns,
                &image.rgb[3 * (row * all_columns + left)]);
    if (!part.alpha.empty())
      std::copy_n(
          &part.alpha[row * columns], columns, &image.alpha[row * all_columns + left]);
  }
}

Image
sideBySide(const Image& left, const Image& right)
{
  Image image{left.width + right.width, left.height, {}, {}};
  image.rgb.resize(left.rgb.size() + right.rgb.size());
  image.alpha.resize(left.alpha.size() + right.alpha.size());
  paste(left, 0, image);
  paste(right, static_cast<std::size_t>(left.width), image);
  return image;
}

void
shift(double columns, PictureBox& box)
{
  box.left += columns;
  box.right += columns;
}
} // namespace

TopViewOptions
BeforeAfterView::defaultOptions()
{
  TopViewOptions options;
  options.colour = PointColour::kScan;
  options.title = "before";
  return options;
}

BeforeAfterView::BeforeAfterView(const TopViewOptions& options,
                                 const std::string& after_title)
: options_(options), after_title_(after_title)
{
  options_.validate();
  require(options.width >= 400, "width", options.width, "at least 400 for two halves");
  options_.width /= 2;
  options_.margin = std::min(options_.margin, options_.width / 8);
}

BeforeAfterPicture
BeforeAfterView::draw(const TopViewScene& before, const TopViewScene& after) const
{
  TopViewOptions options = options_;
  if (!options.area) {
    options.area = areaOf(before, options);
    options.area->extend(areaOf(after, options));
  }
  const TopViewPicture left = TopView(options).draw(before);
  options.title = after_title_;
  options.height = left.layout.height; // only one half may need a line for the legend
  const TopViewPicture right = TopView(options).draw(after);
  BeforeAfterPicture picture{
      sideBySide(left.image, right.image), left.layout, right.layout};
  shift(left.image.width, picture.after.map);
  for (auto* end : {&picture.after.scale_bar_begin, &picture.after.scale_bar_end})
    end->x() += left.image.width;
  return picture;
}

} // namespace pcl6d
