// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scan/table/table_columns.h"

#include <pcl6d/io/text.h>

#include <cstdint>
#include <filesystem>
#include <optional>

/** \file Lines ahead of the points of a text table. */
namespace pcl6d::io {

/** \brief A line of a table with its position. */
struct TableLine {
  const std::filesystem::path& path;
  std::size_t number = 0;
  std::string_view text;

  /** \throws IoFailed "path: line 12: message" */
  [[noreturn]] void
  fail(const std::string& message) const
  {
    text::failAt(path, number, message);
  }
};

/** \brief How the rows of a table are read. */
struct TableLayout {
  std::vector<TableValue> columns; ///< up to the last column read
  char separator =
      0; ///< between cells; 0: any number of blanks, tabs, commas, semicolons
  std::optional<std::uint64_t> count; ///< of points, if given in a line
  std::size_t count_line = 0;         ///< number of the line with the count
  std::vector<std::string> left_out;  ///< ignored columns of the heading
};

/** \return the number of points, if the line is a single plausible number */
std::optional<std::uint32_t>
countOf(std::string_view line);

/** \return whether a line is a remark: begins with # or // */
bool
isRemark(std::string_view line);

/** \brief Reads the lines ahead of the first point: remarks, a line with column names (also
 * after # or //), a line with the number of points. */
class TableHead {
public:
  /** \param[in] columns given by the user, or empty: from the heading, by default x, y and z
   * \param[in] is_pts without a heading a row has x y z, x y z intensity, x y z r g b or x y z
   * intensity r g b */
  TableHead(const std::vector<std::string>& columns, bool is_pts);

  /** \return whether the line is not a point yet \throws IoFailed the line lacks x, y or z, or
   * has a unit other than metres */
  bool
  takes(const TableLine& line);

  /** \param[in] row the first row with a point \return the layout of all rows
   * \throws IoFailed the row has a decimal comma that could also be a separator */
  TableLayout
  layoutFor(const TableLine& row);

private:
  void
  takeColumns(const TableLine& row);
  void
  readNames(const TableLine& line, std::string_view words);

  std::vector<TableValue> given_;
  bool is_pts_;
  bool has_names_ = false;
  TableLayout layout_;
};

} // namespace pcl6d::io
