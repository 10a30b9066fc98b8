// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/** \file Meaning of the columns of a text table of points. */
namespace pcl6d::io {

/** \brief Value of a point in a column. */
enum class TableValue {
  kX,
  kY,
  kZ,
  kIntensity,
  kRed,
  kGreen,
  kBlue,
  kNormalX,
  kNormalY,
  kNormalZ,
  kRing,
  kTime,
  kNone ///< the column is not read
};

constexpr std::size_t kNumTableValues = static_cast<std::size_t>(TableValue::kNone);

/** \return the value for a word of a heading, such as "X", "x [m]", "Easting" or
 * "Points_m_XYZ:0", case-insensitive; kNone for unknown words */
TableValue
tableValueOf(std::string_view word);

/** \return the unit behind a word of a heading: "mm" of "x [mm]" or "x(mm)", else empty */
std::string
unitOf(std::string_view word);

/** \return the columns for the words of --columns; an empty word and "-" skip a column
 * \throws BadArgument a word is unknown or named twice, or x, y or z is missing */
std::vector<TableValue>
tableColumns(const std::vector<std::string>& words);

/** \return the first of x, y, z missing in the columns, else null */
const char*
missingCoordinate(const std::vector<TableValue>& columns);

/** \return the cells of a line, without surrounding blanks and quotes
 * \param[in] separator between cells; ' ' stands for any number of blanks and tabs */
std::vector<std::string_view>
cellsOf(std::string_view line, char separator);

/** \return the separator of a line: a semicolon, else a tab, else a comma, else blanks */
char
separatorOf(std::string_view line);

/** \return the first token with a decimal comma in a line without semicolons and tabs, where
 * blanks or commas separate numbers; or empty */
std::string_view
unclearDecimalComma(std::string_view line);

} // namespace pcl6d::io
