// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace pcl6d::visualization {

/** \return bytes as text (RFC 4648, with padding) */
std::string
base64Of(const void* bytes, std::size_t count);

/** \return the bytes of numbers as text, in the order of the machine */
template <typename T>
std::string
base64Of(const std::vector<T>& numbers)
{
  return base64Of(numbers.data(), numbers.size() * sizeof(T));
}

} // namespace pcl6d::visualization
