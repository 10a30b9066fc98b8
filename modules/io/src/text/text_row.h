// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/text.h>

#include <pcl/PCLPointField.h>

#include <cstdint>

/** \file Fast parsing of rows of numbers. Unusual forms are left to text::Tokens and
 * text::parseNumber(), which accept more and explain errors. */
namespace pcl6d::io {

struct Blank {
  bool
  operator()(char c) const
  {
    return c == ' ' || c == '\t';
  }
};

/** \brief Takes the next number of a row in plain form.
 * \param[in,out] place moved behind the number \param[in] separates tells the characters
 * between numbers \return false, with place and value undefined, at the end of the row, for
 * invalid numbers, or if parseNumber() is needed */
template <typename T, typename Separates>
bool
takeNumber(const char*& place, const char* end, T& value, Separates separates)
{
  while (place != end && separates(*place))
    ++place;
  const auto result = std::from_chars(place, end, value);
  if (result.ec != std::errc() || (result.ptr != end && !separates(*result.ptr)))
    return false;
  place = result.ptr;
  return true;
}

/** \brief A number of a row with its target. */
struct Column {
  std::uint8_t datatype = 0; ///< of PCLPointField
  std::size_t offset = 0;    ///< [byte] in the point
};

/** \return a column for each number of the fields */
std::vector<Column>
columnsOf(const std::vector<pcl::PCLPointField>& fields);

/** \brief Takes a row with exactly the given columns, separated by blanks or tabs.
 * \return false, with the point undefined, if the row is unusual or broken */
bool
takeRow(std::string_view line, const std::vector<Column>& columns, std::uint8_t* point);

} // namespace pcl6d::io
