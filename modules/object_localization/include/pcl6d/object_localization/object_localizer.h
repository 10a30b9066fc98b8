// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/localization_scene.h>
#include <pcl6d/object_localization/localized_object.h>
#include <pcl6d/object_localization/object_model.h>
#include <pcl6d/object_localization/object_proposals.h>
#include <pcl6d/object_localization/pair_features.h>

#include <memory>
#include <vector>

namespace pcl6d::object_localization {
class ObjectRefinement;
struct ObjectCandidate;
} // namespace pcl6d::object_localization

namespace PCL6D_EXPORTS pcl6d {

class DistanceField;
struct ModelSurface;
struct PoseCheck;
struct SceneSurface;
struct VotedPose;

/** \brief Knobs of ObjectLocalizer. */
struct LocalizerOptions {
  double resolution = 0.05;  ///< of the search, as a share of the model's diameter; in
                             ///< [0.02, 0.2]
  int max_candidates = 24;   ///< poses that are refined; > 0
  double min_visible = 0.35; ///< PoseCheck::visibleFraction() of an object
  double min_facing = 0.08;  ///< facing share of the surface, relative to the model's
                             ///< best side: an open shell seen from behind is rejected
  /** Without proposals: supporting elements over the facing elements of the model's
   * best side. In coarser scans, votes of point pairs give false positives. */
  double min_seen = 0.2;
  double min_agreement = 0.88;     ///< PoseCheck::agreement()
  double max_violation = 0.08;     ///< PoseCheck::freeSpaceViolation()
  double max_continuation = 0.4;   ///< PoseCheck::continuation(); >= 0
  std::size_t min_support = 20;    ///< surface elements of the scan on the object; > 0
  double max_shared_support = 0.3; ///< of the weaker of two objects
  unsigned int num_threads = 0;    ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Finds an object of known shape in a scan and its pose in six degrees of
 * freedom, without an initial pose (book 7.2.2).
 *
 * Pairs of points vote for poses (PairFeatureTable), and ICP refines the best poses.
 * PoseCheck tests each pose by the visible surface and by free-space violations. Of
 * poses that explain one surface, the best stays.
 * \code
 * const pcl6d::ObjectLocalizer localizer(
 *     pcl6d::ObjectModel::fromCloud("carton", model_points));
 * for (const auto& carton : localizer.locate(pcl6d::LocalizationScene(scan_points)))
 *   use(carton.T_scene_object);
 * \endcode
 * \ingroup object_localization */
class ObjectLocalizer {
public:
  /** \throws BadArgument an option is invalid */
  explicit ObjectLocalizer(ObjectModel model, const LocalizerOptions& options = {});

  /** \return the objects, best score first; may be empty */
  std::vector<LocalizedObject>
  locate(const LocalizationScene& scene) const;

  const ObjectModel&
  model() const
  {
    return model_;
  }

  /** \brief Finds objects at proposals, for example from proposeObjects(): upright, on
   * the plane that supports the proposal. Also suits coarse scans, in which votes of
   * point pairs are weak.
   * \param[in] proposals of the scene's points \return best score first */
  std::vector<LocalizedObject>
  locate(const LocalizationScene& scene,
         const std::vector<ObjectProposal>& proposals) const;

private:
  SceneSurface
  surfaceOf(const LocalizationScene& scene) const;
  bool
  mayBe(const ObjectProposal& proposal) const;
  std::vector<object_localization::ObjectCandidate>
  placed(const ObjectProposal& proposal,
         const object_localization::ObjectRefinement& refinement,
         const ModelSurface& coarse) const;
  std::vector<LocalizedObject>
  objectsOf(std::vector<object_localization::ObjectCandidate> candidates) const;
  std::vector<VotedPose>
  firstPoses(const SceneSurface& surface) const;
  bool
  accepts(const PoseCheck& check, double min_agreement) const;
  void
  removeRefused(std::vector<object_localization::ObjectCandidate>& candidates,
                double min_agreement) const;
  LocalizedObject
  describe(object_localization::ObjectCandidate candidate) const;

  LocalizerOptions options_;
  ObjectModel model_;
  double voxel_;                               ///< [m] of the search
  double spacing_;                             ///< [m] of the model's points
  OrientedPoints coarse_;                      ///< the model for votes
  std::shared_ptr<const ModelSurface> fine_;   ///< for refinement
  std::size_t most_facing_;                    ///< points of fine_ on its best side
  std::shared_ptr<const DistanceField> field_; ///< of fine_
  PairFeatureTable table_;
};

} // namespace pcl6d
