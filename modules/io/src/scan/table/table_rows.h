// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scan/table/table_head.h"

#include <pcl/PCLPointCloud2.h>

#include <array>
#include <cstdint>

/** \file Conversion of the rows of a text table to points. */
namespace pcl6d::io {

/** \brief Turns rows of a table into points. \tparam T type of the coordinates, float or double
 */
template <typename T>
class TableRows {
public:
  /** \param[out] cloud gets the fields of the columns */
  TableRows(const TableLayout& layout, pcl::PCLPointCloud2& cloud);

  /** \brief Appends the point of a row. An empty cell is NaN.
   * \return false if the line is blank or a remark \throws IoFailed a number is missing or
   * invalid */
  bool
  take(const TableLine& line, std::vector<std::uint8_t>& data);

  /** \return the ignored parts of the rows, for people; empty if rows are read completely */
  std::string
  further() const;

private:
  bool
  takePlain(std::string_view text);
  void
  takeCells(const TableLine& line);
  std::vector<std::string_view>
  split(const TableLine& line);
  void
  takeCell(const TableLine& line, std::string_view cell, TableValue value);
  void
  append(std::vector<std::uint8_t>& data);
  bool
  separates(char c) const;
  bool
  endsCell(char c) const;

  TableLayout layout_;
  std::array<T, kNumTableValues> row_{};
  double time_ = 0;
  std::size_t point_step_ = 0;
  bool has_intensity_ = false, has_colours_ = false, has_normals_ = false;
  bool has_ring_ = false, has_time_ = false;
  std::size_t further_line_ = 0; ///< the first with too many cells; 0: not found
  std::size_t bright_line_ = 0;  ///< the first with a colour above 255; 0: not found
};

extern template class TableRows<float>;
extern template class TableRows<double>;

} // namespace pcl6d::io
