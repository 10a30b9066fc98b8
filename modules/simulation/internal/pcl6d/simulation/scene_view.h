// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/simulation/ray_caster.h>

#include <Eigen/Geometry>

#include <cstdint>
#include <optional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The surroundings of a scanner during a scan, in the scanner's frame; hides
 * scene and motion. \ingroup simulation */
class SceneView {
public:
  virtual ~SceneView() = default;

  /** \brief Finds the first surface along a ray. Thread-safe. \param[in] ray in the
   * scanner's frame at the given time
   * \param[in] time [s] since the start of the scan */
  virtual std::optional<RayHit>
  cast(const Ray& ray, double time) const = 0;

  /** \return the surface of a hit triangle */
  virtual const Surface&
  surface(std::uint32_t triangle) const = 0;
};

/** \brief The view from a fixed scanner in a static scene. */
class StandingView : public SceneView {
public:
  /** Keeps a reference to the caster. \param[in] T_scene_scan pose of the scanner */
  StandingView(const RayCaster& caster, const Eigen::Isometry3d& T_scene_scan)
  : caster_(caster), T_scene_scan_(T_scene_scan)
  {}

  std::optional<RayHit>
  cast(const Ray& ray, double time) const override;

  const Surface&
  surface(std::uint32_t triangle) const override;

private:
  const RayCaster& caster_;
  Eigen::Isometry3d T_scene_scan_;
};

} // namespace pcl6d
