// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scanner/range_scan.h>
#include <pcl6d/simulation/moving_scene.h>

#include <pcl/PCLPointCloud2.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Appends the fields `plane_id`, `object_id` and `label` (uint32, 0: none) of
 * the surface under each point to the cloud of a scan. \param[in] cloud one point per
 * sample
 * \throws BadArgument cloud and scan differ in size \ingroup simulation */
void
addTruthFields(pcl::PCLPointCloud2& cloud,
               const RangeScan& scan,
               const TriangleScene& scene);

/** \brief Appends the field `dynamic` (uint32): 1 for points on a moving body
 * (MovingScene::moves()), else 0. \param[in] cloud one point per sample
 * \return the number of points with 1 \throws BadArgument cloud and scan differ in
 * size, or the cloud has a field `dynamic` */
std::size_t
addDynamicField(pcl::PCLPointCloud2& cloud,
                const RangeScan& scan,
                const MovingScene& scene);

/** \brief Number of points on each plane and object, by id; the size of a vector is the
 * largest id plus one. */
struct TruthCounts {
  std::vector<std::size_t> planes;
  std::vector<std::size_t> objects;

  /** \brief Adds the points of a scan. */
  void
  add(const RangeScan& scan, const TriangleScene& scene);
};

} // namespace pcl6d
