// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/pcd_io.h>

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

/** \file The text at the start of a PCD file. */
namespace pcl6d::io {

/** \brief A PCD header with consistent entries. */
struct PcdHeader {
  std::vector<pcl::PCLPointField> fields; ///< of the file, including padding ("_")
  std::size_t width = 0;
  std::size_t height = 1;
  std::size_t point_size =
      0; ///< [byte] size of a point with all fields, at most kMaxPointSize
  Eigen::Isometry3d viewpoint = Eigen::Isometry3d::Identity(); ///< T_world_scan
  PcdEncoding encoding = PcdEncoding::kAscii;
  std::size_t num_lines = 0; ///< lines of the header; the body follows

  std::size_t
  numPoints() const
  {
    return width * height;
  }
};

constexpr std::int64_t kMaxPointSize = 1 << 20; // [byte]

/** \return whether the field only fills a gap */
inline bool
isPadding(const pcl::PCLPointField& field)
{
  return field.name == "_";
}

/** \return bytes of a value of a PCLPointField's datatype, 0 if unknown */
std::size_t
sizeOfType(std::uint8_t datatype);

/** \brief Reads up to the DATA line; the stream then stands at the body.
 * \throws IoFailed naming line, value and rule */
PcdHeader
readPcdHeader(std::istream& stream, const std::filesystem::path& path);

/** \return the header as text, VIEWPOINT with up to 17 digits */
std::string
toString(const PcdHeader& header);

} // namespace pcl6d::io
