// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/text.h>

#include <pcl/PCLPointField.h>

#include <cstdint>

/** \file Rows of numbers, fast. What is unusual is left to text::Tokens and
 * text::parseNumber(), which take more forms and know what to say about an error.
 * */
namespace pcl6d::io {

struct Blank {
  bool
  operator()(char c) const
  {
    return c == ' ' || c == '\t';
  }
};

/** \brief Takes the next number of a row if it has a plain form.
 * \param[in,out] place moved behind the number \param[in] separates tells the characters
 * between numbers \return false, with place and value undefined, if it is the end of the
 * row or no number, or parseNumber() has to look at it */
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

/** \brief A number of a row, and where it goes. */
struct Column {
  std::uint8_t datatype = 0; ///< of PCLPointField
  std::size_t offset = 0;    ///< [byte] in the point
};

/** \return one column for each number of the fields */
std::vector<Column>
columnsOf(const std::vector<pcl::PCLPointField>& fields);

/** \brief Takes a row of exactly these columns, separated by blanks or tabs.
 * \return false, with the point undefined, if the row is unusual or broken */
bool
takeRow(std::string_view line, const std::vector<Column>& columns, std::uint8_t* point);

} // namespace pcl6d::io
