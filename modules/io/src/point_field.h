// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PCLPointField.h>

#include <cstdint>

/** \file The datatypes of fields. Internal to the module io. */
namespace pcl6d {

/** \brief Calls f with a value-initialised number of the C++ type that a PCLPointField
 * of this datatype holds, and returns what it returns. */
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

} // namespace pcl6d
