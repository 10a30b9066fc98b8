// SPDX-License-Identifier: BSD-3-Clause
#include "hundredfold.h"
#include "text.h"

#include <algorithm>

namespace pcl6d::text {

namespace {
constexpr int kLargestFixed = 15; // exponents of numbers written without one
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

template <typename T>
void
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
    return;
  }
  char digits[32]; // without the point
  const char* const digits_end =
      std::remove_copy(shown.begin(), shown.begin() + e, digits, '.');
  int exponent = 0;
  std::from_chars(&shown[e + (shown[e + 1] == '+' ? 2 : 1)], end, exponent);
  appendDecimal(
      text, {digits, static_cast<std::size_t>(digits_end - digits)}, exponent + 2);
}
} // namespace

void
appendHundredfold(std::string& text, float value)
{
  const std::size_t start = text.size();
  appendShifted(text, value);
  double read = 0;
  std::from_chars(text.data() + start, text.data() + text.size(), read);
  if (static_cast<float>(read / 100) == value || value != value)
    return;
  text.resize(start); // too close to the middle between two floats
  appendNumber(text, 100 * static_cast<double>(value)); // exact in double
}

void
appendHundredfold(std::string& text, double value)
{
  appendShifted(text, value);
}

} // namespace pcl6d::text
