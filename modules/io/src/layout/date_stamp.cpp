// SPDX-License-Identifier: BSD-3-Clause
#include "layout/date_stamp.h"

#include <pcl6d/io/text.h>

#include <array>
#include <string>

namespace pcl6d::io {

namespace {
/** \brief The whole numbers between separators: 2011, 9 and 26 of "2011-09-26". */
std::optional<std::array<int, 3>>
threeNumbers(std::string_view word, char separator)
{
  text::Tokens tokens(word, std::string_view(&separator, 1));
  std::array<int, 3> numbers{};
  for (int& number : numbers)
    if (!text::parseNumber(tokens.next(), number) || number < 0)
      return std::nullopt;
  return tokens.next().empty() ? std::optional(numbers) : std::nullopt;
}

bool
isLeapYear(int year)
{
  return (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
}

int
daysOfMonth(int year, int month)
{
  constexpr std::array<int, 12> kDays = {
      31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  return kDays[static_cast<std::size_t>(month - 1)] +
         (month == 2 && isLeapYear(year) ? 1 : 0);
}

/** \return the days from 1970 to a date of the Gregorian calendar; empty if not a date */
std::optional<int>
daysSince1970(const std::array<int, 3>& date)
{
  const auto [year, month, day] = date;
  if (year < 1970 || year > 9999 || month < 1 || month > 12 || day < 1 ||
      day > daysOfMonth(year, month))
    return std::nullopt;
  int days = day - 1;
  for (int earlier = 1970; earlier < year; ++earlier)
    days += isLeapYear(earlier) ? 366 : 365;
  for (int earlier = 1; earlier < month; ++earlier)
    days += daysOfMonth(year, earlier);
  return days;
}
} // namespace

std::optional<double>
secondsOfDate(std::string_view line)
{
  text::Tokens tokens(line);
  const auto date = threeNumbers(tokens.next(), '-');
  const std::string_view clock = tokens.next();
  if (!date || !tokens.next().empty())
    return std::nullopt;
  const std::size_t point = clock.find('.');
  const auto time = threeNumbers(clock.substr(0, point), ':');
  const auto days = daysSince1970(*date);
  double fraction = 0;
  if (!time || !days || (*time)[0] > 23 || (*time)[1] > 59 || (*time)[2] > 60 ||
      (point != std::string_view::npos &&
       (clock.find_first_not_of("0123456789", point + 1) != std::string_view::npos ||
        !text::parseNumber("0" + std::string(clock.substr(point)), fraction))))
    return std::nullopt;
  const double whole =
      86400.0 * *days + 3600.0 * (*time)[0] + 60.0 * (*time)[1] + (*time)[2];
  return whole + fraction;
}

} // namespace pcl6d::io
