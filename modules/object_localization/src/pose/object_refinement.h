// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/status.h>
#include <pcl6d/object_localization/pose_check.h>
#include <pcl6d/registration/pose_information.h>

#include <optional>

/** \file Refinement of rough object poses. Internal to the module. */
namespace pcl6d::object_localization {

/** \brief A candidate pose of an object. */
struct ObjectCandidate {
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  PoseCheck check;
  Status status = Status::kMaxIterations;
  std::optional<PoseCovariance> covariance;
  double rms = 0;                    ///< [m] of the scan's points to the model
  std::vector<std::uint32_t> points; ///< of the scan on the object, ascending
};

/** \brief [m] Largest distance from a scan point to the nearest model point. */
struct PairGate {
  double start = 0;
  /** smallest gate, at the end: the spacing of the model's points, between which scan
   * points lie even at the exact pose */
  double least = 0;
};

/** \brief Refines poses of one model in one scan, and checks them. */
class ObjectRefinement {
public:
  /** \param[in] model in elements of the surface's size
   * Keeps references to its arguments. */
  ObjectRefinement(const LocalizationScene& scene,
                   const SceneSurface& surface,
                   const ModelSurface& model)
  : scene_(scene), surface_(surface), model_(model), voxel_(model.element)
  {}

  /** \brief ICP of the model's facing part to the surface, twice, as the facing part
   * depends on the pose; then a lenient check. */
  ObjectCandidate
  onSurface(const Eigen::Isometry3d& guess) const;

  /** \brief Checks an unchanged pose, with a surface of any element size. */
  ObjectCandidate
  checked(const Eigen::Isometry3d& T_scene_model, const ModelSurface& model) const;

  /** \brief ICP of a model to the points around it; then a strict check. If ICP fails,
   * the check is empty. \param[in] dense the model with every point */
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
