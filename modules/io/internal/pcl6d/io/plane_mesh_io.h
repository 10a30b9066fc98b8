// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>

#include <Eigen/Core>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A labelled flat polygon, in the form of triangulate(). */
struct LabelledPolygon {
  std::vector<std::vector<Eigen::Vector3d>> rings; ///< [m] outer rings and their holes
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  std::string label = "none";
};

/** \brief Writes polygons as a mesh, binary PLY, atomically: triangles in the colours of the
 * labels (labelColour()); each face has `plane_id`, the polygon's index plus one.
 * \throws IoFailed the file cannot be written \ingroup io */
void
writePolygonMesh(const std::filesystem::path& path,
                 const std::vector<LabelledPolygon>& polygons);

/** \brief Plane and label of a point. */
struct PointLabel {
  std::uint32_t plane_id = 0; ///< from 1; 0: none
  std::uint32_t label = 0;    ///< number of the label
  std::string name = "none";  ///< the label, for the colour
};

/** \brief Writes points with the fields `rgb`, `plane_id` and `label` to PCD or PLY, by
 * extension, atomically. \param[in] label_of index into labels for each point \throws IoFailed
 * the file cannot be written
 * \throws BadArgument the numbers of points and labels differ, or an index is out of range */
void
writeLabelledPoints(const std::filesystem::path& path,
                    const Points& points,
                    const std::vector<std::uint32_t>& label_of,
                    const std::vector<PointLabel>& labels);

} // namespace pcl6d
