// SPDX-License-Identifier: BSD-3-Clause
#include "planes/distance_field.h"

#include <cmath>
#include <limits>

namespace pcl6d::plane_segmentation {

namespace {
constexpr double kFar = 1e12; // squared distance without a cell of the set

/** The lower envelope of parabolas at the values of one line. */
class Envelope {
public:
  explicit Envelope(std::size_t size) : values_(size), feet_(size), begin_(size + 1) {}

  std::vector<double>&
  values()
  {
    return values_;
  }

  /** \brief Replaces each value by the minimum, over every position, of its value plus
   * the squared distance. */
  void
  transform(std::vector<double>& result)
  {
    std::size_t last = 0;
    feet_[0] = 0;
    begin_[0] = -std::numeric_limits<double>::infinity();
    for (std::size_t place = 1; place < values_.size(); ++place) {
      double meets = meeting(feet_[last], place);
      while (meets <= begin_[last])
        meets = meeting(feet_[--last], place);
      feet_[++last] = place;
      begin_[last] = meets;
    }
    std::size_t piece = 0;
    for (std::size_t place = 0; place < values_.size(); ++place) {
      while (piece < last && begin_[piece + 1] < static_cast<double>(place))
        ++piece;
      const double d = static_cast<double>(place) - static_cast<double>(feet_[piece]);
      result[place] = d * d + values_[feet_[piece]];
    }
  }

private:
  double
  meeting(std::size_t a, std::size_t b) const
  {
    const auto x = static_cast<double>(a), y = static_cast<double>(b);
    return (values_[b] + y * y - values_[a] - x * x) / (2 * (y - x));
  }

  std::vector<double> values_;
  std::vector<std::size_t> feet_; // of the parabolas of the envelope
  std::vector<double> begin_;     // where each parabola begins
};
} // namespace

Raster<float>
distanceField(const Raster<char>& set)
{
  Raster<double> squares(set.width, set.height, 0);
  std::vector<double> line(set.height);
  Envelope column(set.height);
  for (std::size_t x = 0; x < set.width; ++x) {
    for (std::size_t y = 0; y < set.height; ++y)
      column.values()[y] = set.at(x, y) ? 0 : kFar;
    column.transform(line);
    for (std::size_t y = 0; y < set.height; ++y)
      squares.at(x, y) = line[y];
  }
  Raster<float> distances(set.width, set.height, 0);
  line.resize(set.width);
  Envelope row(set.width);
  for (std::size_t y = 0; y < set.height; ++y) {
    for (std::size_t x = 0; x < set.width; ++x)
      row.values()[x] = squares.at(x, y);
    row.transform(line);
    for (std::size_t x = 0; x < set.width; ++x)
      distances.at(x, y) = static_cast<float>(std::sqrt(line[x]));
  }
  return distances;
}

} // namespace pcl6d::plane_segmentation
