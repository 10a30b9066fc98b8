// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "e57/page_reader.h"

#include <Eigen/Geometry>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/** \file Scans in the XML section of an E57 file (ASTM E2807, clauses 7 and 8). */
namespace pcl6d::sources {

/** \brief How the values of a field are stored. */
enum class E57Kind {
  kSingle,  ///< 32 bits
  kDouble,  ///< 64 bits
  kInteger, ///< value - minimum, in the bits needed by maximum - minimum
  kScaled,  ///< an integer; the value is integer * scale + offset
  kString   ///< not read
};

/** \brief A field of the points of a scan. */
struct E57Field {
  std::string name; ///< "cartesianX", "nor:normalX"
  E57Kind kind = E57Kind::kDouble;
  std::int64_t minimum = 0; ///< of integers
  std::int64_t maximum = 0;
  double scale = 1;
  double offset = 0;

  bool
  isInteger() const
  {
    return kind == E57Kind::kInteger || kind == E57Kind::kScaled;
  }

  /** \return bits of a value in the file: 0 if every value is the minimum */
  unsigned
  bits() const;

  /** \return the value of a stored integer */
  double
  valueOf(std::int64_t integer) const
  {
    return kind == E57Kind::kScaled ? static_cast<double>(integer) * scale + offset
                                    : static_cast<double>(integer);
  }
};

using E57Limits = std::optional<std::pair<double, double>>;

/** \brief A scan of the file without the points. */
struct E57Scan {
  std::string name;                      ///< name in the file; may be empty
  std::optional<Eigen::Isometry3d> pose; ///< T_world_scan, exactly rigid
  std::optional<double> start;           ///< [s] of the recording, since 1980 (GPS)
  std::uint64_t offset = 0;              ///< physical, of the points
  std::uint64_t count = 0;               ///< of points
  std::vector<E57Field> fields;
  E57Limits intensity;
  std::array<E57Limits, 3> colour; ///< red, green, blue
  bool lines_are_columns = false;  ///< a line of the scanner is a column of the grid
  std::pair<std::uint64_t, std::uint64_t>
      pose_text; ///< bytes of the pose in the XML section; equal: insertion point

  /** \return the index of the field, or empty. A field without a prefix matches any prefix, such
   * as nor:normalX for normalX. */
  std::optional<std::size_t>
  find(const std::string& field) const;

  /** \return "scan 3 (Lobby)" \param[in] index of the scan, from 0 */
  std::string
  title(std::size_t index) const;
};

/** \return the coordinate system of a file in well-known text, or empty
 * \throws IoFailed under the conditions of readE57Layout() */
std::string
e57CoordinateSystem(PageReader& file);

/** \brief Reads the XML section of a file.
 * \throws IoFailed naming file, line or scan, value and rule */
std::vector<E57Scan>
readE57Layout(PageReader& file);

} // namespace pcl6d::sources
