// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/plane_segmentation/plane_finishing.h>
#include <pcl6d/plane_segmentation/plane_hough.h>
#include <pcl6d/plane_segmentation/plane_ransac.h>
#include <pcl6d/plane_segmentation/plane_region_growing.h>

#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Method of plane detection (book 7.1.1). */
enum class PlaneMethod { kRegionGrowing, kRansac, kHough };

/** \return the method called "region-growing", "ransac" or "hough"
 * \throws BadArgument another name */
PlaneMethod
planeMethodFromName(const std::string& name);

/** \return the method's name */
std::string
toString(PlaneMethod method);

/** \brief Knobs of segmentPlanes(). */
struct PlaneSegmentationOptions {
  PlaneOptions planes;
  RegionGrowingOptions region_growing; ///< of kRegionGrowing
  RansacPlaneOptions ransac;           ///< of kRansac
  HoughPlaneOptions hough;             ///< of kHough
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \return the words of choosePlaneMethod(), the method's names first */
std::vector<std::string>
planeMethodWords();

/** \brief Chooses a method by a word: its name, or "hough-" with the name of a variant
 * of kHough, which is stored in the options; "hough" leaves the variant unchanged.
 * \throws BadArgument another word */
PlaneMethod
choosePlaneMethod(const std::string& word, PlaneSegmentationOptions& options);

/** \brief Finds the planes in a cloud: a detector, then finishPlanes(). Bit for bit
 * equal for any number of threads. With fewer than 3 points, or no point on a plane,
 * every finite point is unassigned.
 * \return planes and unassigned points; points are indices into the cloud that `cloud`
 * was made of
 * \throws BadArgument an option is invalid \ingroup plane_segmentation */
PlaneSegments
segmentPlanes(const PlaneCloud& cloud,
              PlaneMethod method = PlaneMethod::kRegionGrowing,
              const PlaneSegmentationOptions& options = {});

} // namespace pcl6d
