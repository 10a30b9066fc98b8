// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>

#include <pcl/PCLPointCloud2.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A field of a cloud as numbers. */
struct FieldValues {
  std::string name;
  bool is_integer = false;    ///< stored in an integer type
  std::vector<double> values; ///< one per point; 64-bit integers beyond 2^53 rounded
};

/** \return the field, or empty if the cloud has no such field. Of a field with several elements
 * the first. \throws BadArgument fields and data do not fit together
 * \ingroup io */
std::optional<FieldValues>
fieldValues(const pcl::PCLPointCloud2& cloud, const std::string& name);

/** \brief Appends a field to every point of a cloud.
 * \param[in] datatype of pcl::PCLPointField, the target of the conversion
 * \throws BadArgument the field exists already, or the numbers of values and points differ */
void
addField(pcl::PCLPointCloud2& cloud,
         const std::string& name,
         std::uint8_t datatype,
         const std::vector<double>& values);

/** \brief Sets a field of every point: an existing field keeps the type, a new field is
 * appended. \param[in] datatype of pcl::PCLPointField, of a new field
 * \throws BadArgument the numbers of values and points differ, or fields and data do not fit
 * together */
void
storeField(pcl::PCLPointCloud2& cloud,
           const std::string& name,
           std::uint8_t datatype,
           const std::vector<double>& values);

/** \brief Keeps selected points of a cloud, in order, as an unorganized cloud.
 * \param[in] keep for each point \throws BadArgument the numbers of flags and points differ */
void
keepPoints(pcl::PCLPointCloud2& cloud, const std::vector<bool>& keep);

/** \return x, y and z of all points, rounded to float
 * \throws BadArgument x, y, z of type float32 or float64 are missing \ingroup io */
Points
coordinatesOf(const pcl::PCLPointCloud2& cloud);

/** \brief Writes points into a cloud's fields x, y and z; further fields stay unchanged.
 * \throws BadArgument x, y, z of type float32 or float64 are missing, or the number of points
 * differs \ingroup io */
void
storeCoordinates(const Points& points, pcl::PCLPointCloud2& cloud);

} // namespace pcl6d
