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

/** \brief One field of a cloud as numbers. */
struct FieldValues {
  std::string name;
  bool is_integer = false;    ///< stored as an integer of any width
  std::vector<double> values; ///< one per point; 64-bit integers beyond 2^53 rounded
};

/** \return the field of that name, or nothing if the cloud has none. Of a field with
 * several elements the first. \throws BadArgument fields and data do not fit together
 * \ingroup io */
std::optional<FieldValues>
fieldValues(const pcl::PCLPointCloud2& cloud, const std::string& name);

/** \brief Appends a field to every point of a cloud.
 * \param[in] datatype of pcl::PCLPointField; values are converted to it
 * \throws BadArgument there is such a field already, or not one value per point */
void
addField(pcl::PCLPointCloud2& cloud,
         const std::string& name,
         std::uint8_t datatype,
         const std::vector<double>& values);

/** \brief Puts values into a field of every point: one that is there keeps its type, else it is
 * appended. \param[in] datatype of pcl::PCLPointField, of a new field
 * \throws BadArgument not one value per point, or fields and data do not fit together */
void
storeField(pcl::PCLPointCloud2& cloud,
           const std::string& name,
           std::uint8_t datatype,
           const std::vector<double>& values);

/** \brief Keeps some of the points of a cloud, in their order, as one list.
 * \param[in] keep one per point \throws BadArgument another number */
void
keepPoints(pcl::PCLPointCloud2& cloud, const std::vector<bool>& keep);

/** \return x, y and z of all points, rounded to float
 * \throws BadArgument no such fields of type float32 or float64 \ingroup io */
Points
coordinatesOf(const pcl::PCLPointCloud2& cloud);

/** \brief Writes points into a cloud's fields x, y and z, leaving all others.
 * \throws BadArgument no such fields of type float32 or float64, or another number of
 * points \ingroup io */
void
storeCoordinates(const Points& points, pcl::PCLPointCloud2& cloud);

} // namespace pcl6d
