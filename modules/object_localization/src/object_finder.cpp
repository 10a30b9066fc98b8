// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/name_table.h>
#include <pcl6d/object_localization/cascade_file.h>
#include <pcl6d/object_localization/detection_proposals.h>
#include <pcl6d/object_localization/object_finder.h>
#include <pcl6d/plane_segmentation/segment_planes.h>

#include <algorithm>
#include <iterator>

namespace pcl6d {

namespace {
ObjectDetector
detectorOf(const StoredModel& stored, const ObjectFinderOptions& options)
{
  std::vector<HaarCascade> cascades;
  if (options.use_range && stored.range_cascade)
    cascades.push_back(readCascade(*stored.range_cascade));
  if (options.use_reflectance && stored.reflectance_cascade)
    cascades.push_back(readCascade(*stored.reflectance_cascade));
  if (cascades.empty())
    throw BadArgument("the model of class '" + stored.model.objectClass() +
                      "' has no cascade for this channel: train a cascade with "
                      "pcl_slam6d_objects train, or use --proposals clusters");
  if (cascades.size() == 1)
    return ObjectDetector(std::move(cascades[0]), options.detector);
  return ObjectDetector(
      std::move(cascades[0]), options.detector, std::move(cascades[1]));
}
} // namespace

ProposalMethod
proposalMethodFromName(const std::string& name)
{
  constexpr Named<ProposalMethod> kMethods[] = {{ProposalMethod::kAuto, "auto"},
                                                {ProposalMethod::kClusters, "clusters"},
                                                {ProposalMethod::kFeatures, "features"},
                                                {ProposalMethod::kCascade, "cascade"}};
  return fromName(kMethods, "proposals", name, WordList::kOr);
}

ObjectFinder::ObjectFinder(std::vector<StoredModel> models,
                           const ObjectFinderOptions& options)
: models_(std::move(models)), options_(options)
{
  options_.detector.validate();
  for (const auto& stored : models_) {
    localizers_.emplace_back(stored.model, options_.localizer);
    detectors_.emplace_back();
    if (options_.proposals == ProposalMethod::kCascade)
      detectors_.back() = detectorOf(stored, options_);
  }
}

std::vector<ObjectProposal>
ObjectFinder::detected(std::size_t model,
                       const PlaneCloud& cloud,
                       const PlaneSegments& planes,
                       const std::vector<float>& reflectance) const
{
  return proposeDetections(cloud,
                           planes,
                           detectors_[model]->detect(cloud.points(), reflectance),
                           models_[model].model.diameter());
}

std::vector<LocalizedObject>
ObjectFinder::find(const Points& points, const std::vector<float>& reflectance) const
{
  const unsigned int num_threads = options_.localizer.num_threads;
  const LocalizationScene scene(points, num_threads);
  std::vector<LocalizedObject> objects;
  const auto take = [&](std::vector<LocalizedObject> found) {
    std::move(found.begin(), found.end(), std::back_inserter(objects));
  };
  const bool by_features =
      options_.proposals == ProposalMethod::kFeatures ||
      (options_.proposals == ProposalMethod::kAuto && scene.isNarrow());
  if (by_features) {
    for (const auto& localizer : localizers_)
      take(localizer.locate(scene));
    return strongestObjects(std::move(objects), options_.max_shared);
  }
  const PlaneCloud cloud(scene.points(), num_threads);
  const PlaneSegments planes = segmentPlanes(cloud);
  ProposalOptions proposing;
  proposing.num_threads = num_threads;
  const bool by_cascade = options_.proposals == ProposalMethod::kCascade;
  const auto clusters = by_cascade ? std::vector<ObjectProposal>()
                                   : proposeObjects(cloud, planes, proposing);
  for (std::size_t m = 0; m < models_.size(); ++m)
    take(localizers_[m].locate(
        scene, by_cascade ? detected(m, cloud, planes, reflectance) : clusters));
  return strongestObjects(std::move(objects), options_.max_shared);
}

} // namespace pcl6d
