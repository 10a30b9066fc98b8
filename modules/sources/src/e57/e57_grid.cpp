// SPDX-License-Identifier: BSD-3-Clause
#include "e57/e57_cloud.h"

#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/vector_field.h>

#include <algorithm>
#include <limits>

namespace pcl6d::sources {

namespace {

/** \return the number of cells from the least to the largest number, inclusive */
double
extentOf(const std::vector<double>& values, double& least)
{
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  least = *low;
  return *high - *low + 1;
}

} // namespace

void
arrangeInRows(bool lines_are_columns, pcl::PCLPointCloud2& cloud)
{
  const auto across = fieldValues(cloud, lines_are_columns ? "column" : "row");
  const auto along = fieldValues(cloud, lines_are_columns ? "row" : "column");
  const std::size_t count = cloud.width;
  if (!across || !along || count == 0)
    return;
  double first_row = 0, first_column = 0;
  const double rows = extentOf(across->values, first_row);
  const double columns = extentOf(along->values, first_column);
  constexpr double kMostCells = 4; // per point; sparser clouds stay a list
  if (rows < 2 || columns < 2 ||
      rows * columns > kMostCells * static_cast<double>(count))
    return;
  const auto width = static_cast<std::size_t>(columns);
  const std::size_t cells = static_cast<std::size_t>(rows) * width;
  const std::size_t step = cloud.point_step;
  std::vector<std::uint8_t> data(cells * step);
  std::vector<bool> taken(cells);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t cell =
        static_cast<std::size_t>(across->values[i] - first_row) * width +
        static_cast<std::size_t>(along->values[i] - first_column);
    if (taken[cell])
      return;
    taken[cell] = true;
    std::copy_n(&cloud.data[i * step], step, &data[cell * step]);
  }
  const VectorField place(cloud.fields, {"x", "y", "z"});
  for (std::size_t cell = 0; cell < cells; ++cell)
    if (!taken[cell])
      place.write(Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()),
                  &data[cell * step]);
  cloud.data = std::move(data);
  cloud.width = static_cast<pcl::uindex_t>(width);
  cloud.height = static_cast<pcl::uindex_t>(rows);
  cloud.row_step = static_cast<pcl::uindex_t>(width * step);
}

} // namespace pcl6d::sources
