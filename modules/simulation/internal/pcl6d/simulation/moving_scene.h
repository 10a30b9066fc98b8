// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/simulation/moving_bodies.h>
#include <pcl6d/simulation/scene_view.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A static scene with moving bodies, at any time.
 * \ingroup simulation */
class MovingScene {
public:
  /** \throws BadArgument the scene or a body breaks a rule \throws ComputeFailed see
   * RayCaster */
  explicit MovingScene(TriangleScene ground, std::vector<MovingBody> bodies = {});

  /** \brief The first surface along a ray at a time. Thread-safe.
   * \param[in] time [s] >= 0 \return its triangle is an index into scene() */
  std::optional<RayHit>
  cast(const Ray& ray, double time) const;

  /** \return the static scene */
  const RayCaster&
  ground() const
  {
    return ground_;
  }

  /** \return triangles and surfaces: first of the static scene, unchanged, then of the
   * bodies in their own frames */
  const TriangleScene&
  scene() const
  {
    return bodies_.size() == 0 ? ground_.scene() : all_;
  }

  /** \return the bodies, moving or not */
  const MovingBodies&
  bodies() const
  {
    return bodies_;
  }

  /** \return whether a triangle of scene() belongs to a moving body */
  bool
  moves(std::uint32_t triangle) const;

  /** \return T_scene_body of the body with a triangle of scene(), at a time [s];
   * identity for the static scene */
  Eigen::Isometry3d
  poseOf(std::uint32_t triangle, double time) const;

private:
  RayCaster ground_;
  MovingBodies bodies_;
  TriangleScene all_;
};

/** \brief The view from a moving or fixed scanner in a moving scene. */
class MovingView : public SceneView {
public:
  /** T_scene_scan at a time of the simulation [s]. */
  using PoseAt = std::function<Eigen::Isometry3d(double)>;

  /** Keeps a reference to the scene. \param[in] stamp when the scan starts [s] */
  MovingView(const MovingScene& scene, PoseAt T_scene_scan, double stamp);

  std::optional<RayHit>
  cast(const Ray& ray, double time) const override;

  const Surface&
  surface(std::uint32_t triangle) const override;

private:
  const MovingScene& scene_;
  PoseAt T_scene_scan_;
  double stamp_;
};

} // namespace pcl6d
