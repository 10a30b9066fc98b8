// SPDX-License-Identifier: BSD-3-Clause
#include "text/centimetres.h"

#include <pcl6d/io/text.h>

#include <algorithm>

namespace pcl6d::io {

namespace {
constexpr int kLargestFixed = 15; // exponents of numbers in fixed notation
constexpr int kSmallestFixed = -5;

/** Appends 0.d1 d2 d3... times 10^(exponent + 1). */
void
appendDecimal(std::string& text, std::string_view digits, int exponent)
{
  if (exponent > kLargestFixed || exponent < kSmallestFixed) {
    text += digits[0];
    if (digits.size() > 1)
      (text += '.') += digits.substr(1);
    text += 'e' + std::to_string(exponent);
    return;
  }
  if (exponent < 0) {
    text.append("0.").append(static_cast<std::size_t>(-exponent - 1), '0') += digits;
    return;
  }
  const auto whole = static_cast<std::size_t>(exponent) + 1;
  text += digits.substr(0, whole);
  if (digits.size() > whole)
    (text += '.') += digits.substr(whole);
  else
    text.append(whole - digits.size(), '0');
}

/** \return the number of decimal places in the value's own text; 0 if not finite */
template <typename T>
int
appendShifted(std::string& text, T value)
{
  char buffer[32];
  const char* const end =
      std::to_chars(buffer, std::end(buffer), value, std::chars_format::scientific).ptr;
  std::string_view shown(buffer, static_cast<std::size_t>(end - buffer));
  if (shown.front() == '-') {
    text += '-';
    shown.remove_prefix(1);
  }
  const std::size_t e = shown.find('e');
  if (value == 0 || e == std::string_view::npos) { // 0, or not finite
    text += shown.substr(0, e);
    return 0;
  }
  char digits[32]; // without the point
  const char* const digits_end =
      std::remove_copy(shown.begin(), shown.begin() + e, digits, '.');
  int exponent = 0;
  std::from_chars(&shown[e + (shown[e + 1] == '+' ? 2 : 1)], end, exponent);
  const auto count = static_cast<std::size_t>(digits_end - digits);
  appendDecimal(text, {digits, count}, exponent + 2);
  return static_cast<int>(count) - 1 - exponent;
}
} // namespace

// A text of up to 9 digits with q decimal places is a multiple of 10^-q, and the middle between
// two floats an odd multiple, below 2^25, of a power of 2. The two therefore differ by at least
// a relative 2^-25 5^-q, or are equal: up to q = 11 by more than the two roundings of double,
// 2^-52, which then cannot change the float.
void
appendCentimetres(std::string& text, float value)
{
  constexpr int kSafePlaces = 11;
  const std::size_t start = text.size();
  if (appendShifted(text, value) <= kSafePlaces)
    return;
  double read = 0;
  std::from_chars(text.data() + start, text.data() + text.size(), read);
  if (static_cast<float>(read / 100) == value)
    return;
  text.resize(start);
  text::appendNumber(text, 100 * static_cast<double>(value)); // exact in double
}

void
appendCentimetres(std::string& text, double value)
{
  appendShifted(text, value);
}

} // namespace pcl6d::io
