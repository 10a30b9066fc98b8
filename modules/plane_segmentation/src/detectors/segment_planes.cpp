// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/name_table.h>
#include <pcl6d/common/require.h>
#include <pcl6d/plane_segmentation/segment_planes.h>

namespace pcl6d {

namespace {
constexpr Named<PlaneMethod> kMethods[] = {
    {PlaneMethod::kRegionGrowing, "region-growing"},
    {PlaneMethod::kRansac, "ransac"},
    {PlaneMethod::kHough, "hough"}};
const std::string kHoughPrefix = "hough-"; // prefix of the words for its variants

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
  return fromName(kMethods, "plane method", name, WordList::kOneOf);
}

std::string
toString(PlaneMethod method)
{
  return nameOf(kMethods, method, kMethods[0].name);
}

std::vector<std::string>
planeMethodWords()
{
  std::vector<std::string> words = namesOf(kMethods);
  for (const auto& variant : houghVariantNames())
    words.push_back(kHoughPrefix + variant);
  return words;
}

PlaneMethod
choosePlaneMethod(const std::string& word, PlaneSegmentationOptions& options)
{
  if (const auto method = findNamed(kMethods, word))
    return *method;
  for (const auto& variant : houghVariantNames())
    if (word == kHoughPrefix + variant) {
      options.hough.variant = houghVariantFromName(variant);
      return PlaneMethod::kHough;
    }
  std::string rule = "one of ";
  for (const auto& known : planeMethodWords())
    rule += (known == kMethods[0].name ? "" : ", ") + known;
  require(false, "plane method", word, rule);
  return {};
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
