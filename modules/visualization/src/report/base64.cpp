// SPDX-License-Identifier: BSD-3-Clause
#include "report/base64.h"

#include <algorithm>
#include <cstdint>

namespace pcl6d::visualization {

std::string
base64Of(const void* bytes, std::size_t count)
{
  constexpr char kDigits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto* in = static_cast<const std::uint8_t*>(bytes);
  std::string text;
  text.reserve((count + 2) / 3 * 4);
  for (std::size_t i = 0; i < count; i += 3) { // three bytes are four digits
    const std::size_t there = std::min<std::size_t>(3, count - i);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (k < there ? in[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= there ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

} // namespace pcl6d::visualization
