// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/object_detector.h>
#include <pcl6d/object_localization/object_proposals.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Where detections say that an object is (book 7.2.2, step 1): of the points in the
 * box of each, those that are on no floor or wall and not behind the first surface. A
 * detection of fewer than 10 such points, or over no level plane, proposes nothing.
 * \param[in] cloud of finite points only, so that its places are those of the detections
 * \param[in] planes of the cloud
 * \param[in] depth [m] > 0 of an object along the sight, at most
 * \throws BadArgument depth breaks its rule \ingroup object_localization */
std::vector<ObjectProposal>
proposeDetections(const PlaneCloud& cloud,
                  const PlaneSegments& planes,
                  const std::vector<DetectedObject>& detections,
                  double depth);

} // namespace pcl6d
