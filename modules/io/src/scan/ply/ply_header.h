// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "text/file_input.h"

#include <cstdint>

/** \file The text at the start of a PLY file. */
namespace pcl6d::io {

enum class PlyEncoding { kAscii, kLittleEndian, kBigEndian };

/** \brief A value, or a list of values preceded by its length. */
struct PlyProperty {
  std::string name;
  std::uint8_t datatype = 0; ///< of PCLPointField
  bool is_list = false;
  std::uint8_t length_datatype = 0; ///< of a list, an integer type
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::kAscii;
  std::vector<PlyElement> elements;
};

/** \brief Reads the lines of the header; the input then stands at the body.
 * \throws IoFailed naming line, value and rule */
PlyHeader
readPlyHeader(FileInput& input);

} // namespace pcl6d::io
