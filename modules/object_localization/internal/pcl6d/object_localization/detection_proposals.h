// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/object_detector.h>
#include <pcl6d/object_localization/object_proposals.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Proposes an object where a detection is (book 7.2.2, step 1): the points in
 * the box of the detection that are on no floor or wall and not behind the first
 * surface. A detection with fewer than 10 proposed points, or over no level plane,
 * gives no proposal.
 * \param[in] cloud of finite points only, so that its indices agree with the detections
 * \param[in] planes of the cloud
 * \param[in] depth [m] > 0; largest depth of an object along the line of sight
 * \throws BadArgument depth is invalid \ingroup object_localization */
std::vector<ObjectProposal>
proposeDetections(const PlaneCloud& cloud,
                  const PlaneSegments& planes,
                  const std::vector<DetectedObject>& detections,
                  double depth);

} // namespace pcl6d
