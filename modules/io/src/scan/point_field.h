// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PCLPointField.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

/** \file The datatypes of fields, and their values in memory. */
namespace pcl6d::io {

/** \brief Calls f with a value-initialised number of the C++ type for a PCLPointField datatype,
 * and returns the result of f. */
template <typename F>
auto
withTypeOf(std::uint8_t datatype, F&& f)
{
  using Field = pcl::PCLPointField;
  switch (datatype) {
  case Field::INT8:
    return f(std::int8_t{});
  case Field::UINT8:
    return f(std::uint8_t{});
  case Field::INT16:
    return f(std::int16_t{});
  case Field::UINT16:
    return f(std::uint16_t{});
  case Field::INT32:
    return f(std::int32_t{});
  case Field::UINT32:
    return f(std::uint32_t{});
  case Field::INT64:
    return f(std::int64_t{});
  case Field::UINT64:
    return f(std::uint64_t{});
  case Field::FLOAT64:
    return f(double{});
  default:
    return f(float{});
  }
}

/** \brief Copies values of `size` bytes at strides of `step` bytes. */
inline void
copyValues(const std::uint8_t* source,
           std::size_t source_step,
           std::uint8_t* target,
           std::size_t target_step,
           std::size_t size,
           std::size_t count)
{
  const auto copy = [&](auto bytes) { // a size known to the compiler
    for (std::size_t i = 0; i < count; ++i)
      std::memcpy(target + i * target_step, source + i * source_step, bytes);
  };
  if (size == 4)
    copy(std::integral_constant<std::size_t, 4>());
  else if (size == 8)
    copy(std::integral_constant<std::size_t, 8>());
  else
    copy(size);
}

} // namespace pcl6d::io
