// SPDX-License-Identifier: BSD-3-Clause
#include "cluster_width.h"
#include "edge_lines.h"

#include <pcl6d/search/point_tree.h>

#include <algorithm>

namespace pcl6d::moving_objects {

namespace {
/** [cells] Narrower objects are a single line. Points lie anywhere in their cells, so widthOf()
 * is up to 1 for a line. Two lines have 1.7, down to 1.25 where points are denser than cells. */
constexpr double kLineCells = 1.1;

/** [cells] If the points around are farther apart, like reduced points, a line gives no
 * information. */
constexpr double kDenseCells = 1.5;

/** \return of each object whether most of its places have a place of another object, or of none,
 * beside them */
std::vector<bool>
areDenseAround(const TestedPositions& observed,
               const std::vector<int>& object,
               std::size_t count,
               unsigned int num_threads)
{
  Points directions;
  directions.reserve(object.size());
  for (std::size_t place = 0; place < object.size(); ++place)
    directions.push_back(observed.directionOf(place));
  const PointTree tree(directions, num_threads);
  const auto apart = static_cast<float>(kDenseCells * observed.cell);
  std::vector<std::size_t> dense(count, 0), all(count, 0);
  for (std::size_t place = 0; place < object.size(); ++place) {
    if (object[place] < 0)
      continue;
    const auto near = tree.withinRadius(directions[place], apart * apart);
    const auto of = static_cast<std::size_t>(object[place]);
    ++all[of];
    dense[of] += std::any_of(near.begin(), near.end(), [&](const Neighbour& n) {
      return object[static_cast<std::size_t>(n.index)] != object[place];
    });
  }
  std::vector<bool> is_dense;
  is_dense.reserve(count);
  for (std::size_t k = 0; k < count; ++k)
    is_dense.push_back(2 * dense[k] > all[k]);
  return is_dense;
}
} // namespace

std::vector<bool>
areEdgeLines(const TestedPositions& observed,
             const std::vector<int>& object,
             std::size_t count,
             unsigned int num_threads)
{
  std::vector<std::vector<Eigen::Vector3d>> directions(count);
  for (std::size_t place = 0; place < object.size(); ++place)
    if (object[place] >= 0)
      directions[static_cast<std::size_t>(object[place])].push_back(
          observed.directionOf(place).cast<double>());
  std::vector<bool> is_line;
  is_line.reserve(count);
  for (const auto& of_object : directions)
    is_line.push_back(arcWidthOf(of_object) < kLineCells * observed.cell);
  if (std::find(is_line.begin(), is_line.end(), true) == is_line.end())
    return is_line;
  const auto is_dense = areDenseAround(observed, object, count, num_threads);
  for (std::size_t k = 0; k < count; ++k)
    is_line[k] = is_line[k] && is_dense[k];
  return is_line;
}

} // namespace pcl6d::moving_objects
