// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/simulation/moving_body.h>
#include <pcl6d/simulation/ray_caster.h>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Moving bodies, to be hit by rays at any time. \ingroup simulation */
class MovingBodies {
public:
  /** \throws BadArgument a body breaks a rule \throws ComputeFailed see RayCaster */
  explicit MovingBodies(std::vector<MovingBody> bodies = {});

  /** \brief The first body along a ray at a time. Thread-safe.
   * \param[in] time [s] \param[in] max_range [m] farther bodies are ignored
   * \return its triangle is an index into shapes() */
  std::optional<RayHit>
  cast(const Ray& ray,
       double time,
       double max_range = std::numeric_limits<double>::infinity()) const;

  /** \return the shapes of the bodies, one after another, each in its own frame */
  const TriangleScene&
  shapes() const
  {
    return shapes_;
  }

  std::size_t
  size() const
  {
    return bodies_.size();
  }

  /** \param[in] i below size() */
  const MovingBody&
  body(std::size_t i) const
  {
    return bodies_[i].body;
  }

  /** \return the index of the body with a triangle of shapes() */
  std::size_t
  bodyOf(std::uint32_t triangle) const;

private:
  struct Ball {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double radius = 0; // [m]
    bool
    isMissedBy(const Ray& ray) const;
  };
  struct Moving {
    MovingBody body;
    RayCaster caster;
    std::uint32_t first_triangle; // in shapes_
    Ball shape;                   // in the body's frame
    Ball reach;                   // in the scene, around every position of the shape
  };
  std::vector<Moving> bodies_;
  TriangleScene shapes_;
};

} // namespace pcl6d
