// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

/** \file Numbers in the bytes of LAS files, in little-endian order. */
namespace pcl6d::io {

/** \return the number stored at an address */
template <typename T>
T
lasNumber(const void* place)
{
  static_assert(std::is_arithmetic_v<T>);
#if __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "LAS files are read as they are in memory"
#endif
  T value;
  std::memcpy(&value, place, sizeof value);
  return value;
}

template <typename T>
void
storeLasNumber(void* place, T value)
{
  static_assert(std::is_arithmetic_v<T>);
  std::memcpy(place, &value, sizeof value);
}

} // namespace pcl6d::io
