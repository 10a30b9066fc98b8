// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/plane_segmentation/plane_segment.h>
#include <pcl6d/scene_interpretation/label_rules.h>

#include <filesystem>
#include <vector>

/** \file The outputs of an interpreted scene. */
namespace PCL6D_EXPORTS pcl6d {

/** \return per point the index of its plane plus one; 0: on no plane
 * \throws BadArgument a point index is out of range \ingroup scene_interpretation */
std::vector<std::uint32_t>
planeIds(const std::vector<PlaneSegment>& segments, std::size_t num_points);

/** \brief Writes the outlines of planes, with holes, as a coloured triangle mesh (PLY,
 * see writePolygonMesh()); the hull of a plane without outline.
 * \throws IoFailed the file cannot be written */
void
writeLabelledHulls(const std::filesystem::path& path,
                   const std::vector<PlaneSegment>& segments);

/** \brief Writes a cloud with the fields `rgb`, `plane_id` (the index of its plane plus
 * one) and `label` (labelNumber()) as PCD or PLY.
 * \param[in] rules of the labels
 * \throws IoFailed the file cannot be written \throws BadArgument a point index is out
 * of range, or a label is not in the rules */
void
writeLabelledCloud(const std::filesystem::path& path,
                   const Points& points,
                   const std::vector<PlaneSegment>& segments,
                   const LabelRules& rules = bookRules());

} // namespace pcl6d
