// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/object_localization/localized_object.h>
#include <pcl6d/object_localization/model_store.h>
#include <pcl6d/object_localization/object_detector.h>
#include <pcl6d/object_localization/object_localizer.h>

#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Where objects are searched for. */
enum class ProposalMethod {
  kAuto,     ///< features in a camera's narrow view, else clusters
  kClusters, ///< segments that stand on planes
  kFeatures, ///< anywhere, by pairs of points
  kCascade   ///< where the model's cascades detect an object
};

/** \throws BadArgument the name is not auto, clusters, features or cascade */
ProposalMethod
proposalMethodFromName(const std::string& name);

/** \brief Knobs of ObjectFinder. */
struct ObjectFinderOptions {
  ProposalMethod proposals = ProposalMethod::kAuto;
  LocalizerOptions localizer;
  DetectorOptions detector;
  /** which cascades of a model kCascade uses */
  bool use_range = true;
  bool use_reflectance = true;
  double max_shared = 0.3; ///< of the points of the smaller of two objects
};

/** \brief Finds objects of several models in scans (book 7.2): proposals, poses, and of
 * objects that share points the object with the most evidence.
 * \code
 * const pcl6d::ObjectFinder finder({pcl6d::readStoredModel("share/models/chair")});
 * for (const auto& found : finder.find(points)) // [m], the scanner at the origin
 *   use(found.object_class, found.T_scene_object);
 * \endcode
 * \ingroup object_localization */
class ObjectFinder {
public:
  /** \throws BadArgument an option is invalid, or kCascade is chosen and a model has no
   * usable cascade
   * \throws IoFailed a cascade cannot be read */
  explicit ObjectFinder(std::vector<StoredModel> models,
                        const ObjectFinderOptions& options = {});

  /** \param[in] points [m] finite, in the scan's frame, the scanner at the origin
   * \param[in] reflectance one per point, or empty
   * \return most evidence first \throws BadArgument fewer than 10 points */
  std::vector<LocalizedObject>
  find(const Points& points, const std::vector<float>& reflectance = {}) const;

  const std::vector<StoredModel>&
  models() const
  {
    return models_;
  }

private:
  std::vector<ObjectProposal>
  detected(std::size_t model,
           const PlaneCloud& cloud,
           const PlaneSegments& planes,
           const std::vector<float>& reflectance) const;

  std::vector<StoredModel> models_;
  ObjectFinderOptions options_;
  std::vector<ObjectLocalizer> localizers_;
  std::vector<std::optional<ObjectDetector>> detectors_;
};

} // namespace pcl6d
