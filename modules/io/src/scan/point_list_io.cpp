// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/number_range.h>
#include <pcl6d/io/point_list_io.h>
#include <pcl6d/io/text.h>

#include <cmath>

namespace pcl6d {

std::vector<Eigen::Vector3d>
readPointList(const std::filesystem::path& path)
{
  const std::string content = text::readFile(path);
  std::vector<Eigen::Vector3d> points;
  std::vector<double> row;
  text::Lines lines(content);
  while (lines.next()) {
    if (text::isBlank(lines.line()) || lines.line().front() == '#')
      continue;
    text::readRow(path, lines, row);
    if (row.size() != 3)
      text::failAt(path,
                   lines.number(),
                   "expected 3 numbers, got " + std::to_string(row.size()));
    points.emplace_back(row[0], row[1], row[2]);
    if (!isPlace(points.back()))
      text::failAt(path,
                   lines.number(),
                   points.back().allFinite() ? "a coordinate of 1e9 m or more"
                                             : "a coordinate is not finite");
  }
  return points;
}

} // namespace pcl6d
