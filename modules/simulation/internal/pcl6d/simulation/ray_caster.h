// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scanner/ray.h>
#include <pcl6d/simulation/triangle_scene.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A ray prepared for tests against many triangles, in double.
 *
 * The test is watertight: of two triangles that share an edge's vertices, a ray through
 * the edge hits at least one, because both compute the same edge function with opposite
 * sign. Both sides of a triangle count.
 * \note Source: S. Woop, C. Benthin, I. Wald, "Watertight ray/triangle intersection",
 * Journal of Computer Graphics Techniques 2(1), 2013. \ingroup simulation */
class RayTest {
public:
  explicit RayTest(const Ray& ray);

  /** \return range > 0 [m] at which the ray meets the triangle; infinity for a miss, or
   * a ray within the triangle's plane */
  double
  range(const Eigen::Vector3d& a,
        const Eigen::Vector3d& b,
        const Eigen::Vector3d& c) const;

private:
  Eigen::Vector3d origin_;
  int kx_, ky_, kz_; // kz_: the dominant axis of the ray
  double shear_x_, shear_y_, scale_z_;
};

/** \brief End of a ray on a surface. */
struct RayHit {
  double range = 0; ///< [m] along the ray
  std::uint32_t triangle = 0;
  double cos_incidence = 1;    ///< |cosine| between ray and surface normal, in [0, 1]
  bool is_from_behind = false; ///< the ray hit the triangle's back
};

/** \brief Finds the first triangle along a ray.
 *
 * The result equals RayTest against every triangle of the scene, bit for bit: the
 * smallest range, of equal ranges the lowest index. Embree only lists the candidates:
 * it walks a tree of bounding boxes, padded beyond its float rounding, and calls
 * RayTest at the leaves. So the bytes of a simulated scan do not depend on Embree's
 * version or the CPU's vector unit. Cost: O(log n) per ray.
 * \ingroup simulation */
class RayCaster {
public:
  /** \throws BadArgument the scene is invalid or has no triangle \throws ComputeFailed
   * Embree cannot start or is out of memory */
  explicit RayCaster(TriangleScene scene);
  ~RayCaster();
  RayCaster(RayCaster&&) noexcept;
  RayCaster&
  operator=(RayCaster&&) noexcept;

  /** \brief Thread-safe. \param[in] ray in the scene \param[in] max_range [m] farther
   * surfaces are ignored */
  std::optional<RayHit>
  cast(const Ray& ray,
       double max_range = std::numeric_limits<double>::infinity()) const;

  const TriangleScene&
  scene() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace pcl6d
