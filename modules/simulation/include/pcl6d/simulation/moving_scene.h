// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/simulation/moving_bodies.h>
#include <pcl6d/simulation/scene_view.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A scene that stands still and the bodies that move through it, at any time.
 * \ingroup simulation */
class MovingScene {
public:
  /** \throws BadArgument the scene or a body breaks a rule \throws ComputeFailed see
   * RayCaster */
  explicit MovingScene(TriangleScene ground, std::vector<MovingBody> bodies = {});

  /** \brief The first thing along a ray, as it is at that time. Thread-safe.
   * \param[in] time [s] >= 0 \return its triangle is one of scene() */
  std::optional<RayHit>
  cast(const Ray& ray, double time) const;

  /** \return what stands still */
  const RayCaster&
  ground() const
  {
    return ground_;
  }

  /** \return all triangles and surfaces: those of the ground as they were given, then
   * those of the bodies in their own frames */
  const TriangleScene&
  scene() const
  {
    return bodies_.size() == 0 ? ground_.scene() : all_;
  }

  /** \return what moves, or could */
  const MovingBodies&
  bodies() const
  {
    return bodies_;
  }

  /** \return whether a triangle of scene() belongs to a body that moves */
  bool
  moves(std::uint32_t triangle) const;

  /** \return T_scene_body of what a triangle of scene() belongs to, at a time [s];
   * identity for the ground */
  Eigen::Isometry3d
  poseOf(std::uint32_t triangle, double time) const;

private:
  RayCaster ground_;
  MovingBodies bodies_;
  TriangleScene all_;
};

/** \brief The view from a scanner that moves, or stands, in a moving scene. */
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
