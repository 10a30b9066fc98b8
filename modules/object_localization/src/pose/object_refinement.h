// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/status.h>
#include <pcl6d/object_localization/pose_check.h>
#include <pcl6d/registration/pose_information.h>

#include <optional>

/** \file From a rough pose of an object to a precise one. Internal to the module. */
namespace pcl6d::object_localization {

/** \brief A pose that may be that of an object. */
struct ObjectCandidate {
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  PoseCheck check;
  Status status = Status::kMaxIterations;
  std::optional<PoseCovariance> covariance;
  double rms = 0;                    ///< [m] of the scan's points to the model
  std::vector<std::uint32_t> points; ///< of the scan on the object, ascending
};

/** \brief [m] How far a point of the scan may be from the nearest one of the model. */
struct PairGate {
  double start = 0;
  /** at the end, at least: the spacing of the model's points, between which those of the
   * scan lie even if the pose is exact */
  double least = 0;
};

/** \brief Makes poses of one model in one scan precise, and checks them. */
class ObjectRefinement {
public:
  /** \param[in] model in elements of the size of the surface's
   * Keeps references to all three. */
  ObjectRefinement(const LocalizationScene& scene,
                   const SceneSurface& surface,
                   const ModelSurface& model)
  : scene_(scene), surface_(surface), model_(model), voxel_(model.element)
  {}

  /** \brief ICP of the model's facing part to the surface, twice, as the pose says which
   * part faces the scanner; then a lenient check. */
  ObjectCandidate
  onSurface(const Eigen::Isometry3d& guess) const;

  /** \brief A pose as it is, checked with a surface of any element size. */
  ObjectCandidate
  checked(const Eigen::Isometry3d& T_scene_model, const ModelSurface& model) const;

  /** \brief ICP of a model to all points around it; then a strict check. Where ICP fails,
   * nothing supports the candidate. \param[in] dense the model with all its points */
  ObjectCandidate
  onPoints(const ObjectCandidate& candidate,
           const OrientedPoints& dense,
           const PairGate& gate) const;

  const LocalizationScene&
  scene() const
  {
    return scene_;
  }

private:
  Points
  pointsAround(const Eigen::Isometry3d& T_scene_model,
               const OrientedPoints& dense,
               std::vector<std::uint32_t>& places) const;
  const LocalizationScene& scene_;
  const SceneSurface& surface_;
  const ModelSurface& model_;
  double voxel_;
};

} // namespace pcl6d::object_localization
