// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/plane_segmentation/segment_planes.h>

namespace pcl6d {

namespace {
PlaneCandidates
candidatesBy(const PlaneCloud& cloud,
             PlaneMethod method,
             const PlaneSegmentationOptions& options)
{
  switch (method) {
  case PlaneMethod::kRegionGrowing:
    return regionGrowingCandidates(cloud, options.region_growing);
  case PlaneMethod::kRansac:
    return ransacCandidates(cloud, options.ransac);
  case PlaneMethod::kHough:
    return houghCandidates(cloud, options.hough);
  }
  throw BadArgument("plane method = " + std::to_string(static_cast<int>(method)) +
                    ", but must be one of PlaneMethod");
}
} // namespace

PlaneMethod
planeMethodFromName(const std::string& name)
{
  for (const auto method :
       {PlaneMethod::kRegionGrowing, PlaneMethod::kRansac, PlaneMethod::kHough})
    if (name == toString(method))
      return method;
  throw BadArgument("plane method = " + name +
                    ", but must be one of region-growing, ransac, hough");
}

std::string
toString(PlaneMethod method)
{
  switch (method) {
  case PlaneMethod::kRansac:
    return "ransac";
  case PlaneMethod::kHough:
    return "hough";
  case PlaneMethod::kRegionGrowing:
    break;
  }
  return "region-growing";
}

void
PlaneSegmentationOptions::validate() const
{
  planes.validate();
  region_growing.validate();
  ransac.validate();
  hough.validate();
}

PlaneSegments
segmentPlanes(const PlaneCloud& cloud,
              PlaneMethod method,
              const PlaneSegmentationOptions& options)
{
  options.validate();
  return finishPlanes(cloud, candidatesBy(cloud, method, options), options.planes);
}

} // namespace pcl6d
