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
 * The test is watertight: of two triangles that share an edge's vertices at least one
 * is hit by a ray through that edge, because both compute the same edge function with
 * opposite sign. Both sides of a triangle count.
 * \note Source: S. Woop, C. Benthin, I. Wald, "Watertight ray/triangle intersection",
 * Journal of Computer Graphics Techniques 2(1), 2013. \ingroup simulation */
class RayTest {
public:
  explicit RayTest(const Ray& ray);

  /** \return range > 0 [m] at which the ray meets the triangle, infinity if it does not
   * or runs within its plane */
  double
  range(const Eigen::Vector3d& a,
        const Eigen::Vector3d& b,
        const Eigen::Vector3d& c) const;

private:
  Eigen::Vector3d origin_;
  int kx_, ky_, kz_; // kz_: the axis along which the ray runs most
  double shear_x_, shear_y_, scale_z_;
};

/** \brief Where a ray ends. */
struct RayHit {
  double range = 0; ///< [m] along the ray
  std::uint32_t triangle = 0;
  double cos_incidence = 1;    ///< |cosine| between ray and surface normal, in [0, 1]
  bool is_from_behind = false; ///< the ray came in against the triangle's back
};

/** \brief Finds the first triangle along a ray.
 *
 * The answer is that of RayTest against every triangle of the scene, bit for bit: the
 * smallest range, of equal ranges the lowest index. Embree only lists the candidates:
 * it walks a tree of bounding boxes that are padded beyond its float rounding, and
 * calls our own test at the leaves. So the bytes of a simulated scan do not depend on
 * Embree's version or on the vector unit that it finds. Cost: O(log n) per ray.
 * \ingroup simulation
 */
class RayCaster {
public:
  /** \throws BadArgument the scene is invalid or has no triangle \throws ComputeFailed
   * Embree cannot start or is out of memory */
  explicit RayCaster(TriangleScene scene);
  ~RayCaster();
  RayCaster(RayCaster&&) noexcept;
  RayCaster&
  operator=(RayCaster&&) noexcept;

  /** \brief Thread-safe. \param[in] max_range [m] farther surfaces are not seen */
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
