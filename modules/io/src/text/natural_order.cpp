// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/io/natural_order.h>

#include <algorithm>

namespace pcl6d {

namespace {

bool
isDigit(char c)
{
  return c >= '0' && c <= '9';
}

/** \return the digits at the start of the text without leading zeros, and removes them
 * from it */
std::string_view
takeNumber(std::string_view& text)
{
  const auto end = static_cast<std::size_t>(
      std::find_if_not(text.begin(), text.end(), isDigit) - text.begin());
  std::string_view digits = text.substr(0, end);
  text.remove_prefix(end);
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
  return digits;
}

} // namespace

bool
naturalLess(std::string_view a, std::string_view b)
{
  const std::string_view whole_a = a;
  const std::string_view whole_b = b;
  while (!a.empty() && !b.empty()) {
    if (isDigit(a.front()) && isDigit(b.front())) {
      const auto number_a = takeNumber(a);
      const auto number_b = takeNumber(b);
      if (number_a.size() != number_b.size())
        return number_a.size() < number_b.size();
      if (number_a != number_b)
        return number_a < number_b;
      continue;
    }
    if (a.front() != b.front())
      return a.front() < b.front();
    a.remove_prefix(1);
    b.remove_prefix(1);
  }
  if (a.empty() != b.empty())
    return a.empty();
  return whole_a < whole_b;
}

} // namespace pcl6d
