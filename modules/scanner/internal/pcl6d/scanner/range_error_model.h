// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/random.h>
#include <pcl6d/scanner/ray.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Laser spot of one measurement; by default a point. */
struct BeamOptions {
  double exit_diameter = 0; ///< [m] diameter at the scanner, >= 0
  double divergence = 0;    ///< [rad] full angle, in [0, pi / 2]
  int rays = 1;             ///< rays per spot, in [1, 1000]; 1: only the axis
  /** [m] >= 0: surfaces in one spot up to this distance apart (each from the next) give
   * a single echo at a range between them, a mixed pixel: half the length of a pulse;
   * of several echoes the strongest counts */
  double echo_separation = std::numeric_limits<double>::infinity();
};

/** \brief Error model of ranges (book 2.1); by default constant noise only. */
struct RangeOptions {
  double noise = 0.01;    ///< [m] standard deviation of a range, >= 0
  double min_range = 0.2; ///< [m] shorter ranges are no return; >= 0
  double max_range = 30;  ///< [m] longer ranges are no return; > min_range

  /// \name Further noise, independent of `noise` and of each other; each >= 0
  ///@{
  double noise_per_range = 0; ///< [m/m] times the range: time of flight over far ways
  double noise_per_range_sq =
      0; ///< [1/m] times the squared range: triangulation, 1 / (b f) px
  double incidence_noise = 0; ///< [m] times the tangent of the angle of incidence
  double signal_noise = 0;    ///< [m] over the root of the intensity: dark surfaces
  ///@}

  double quantum = 0; ///< [m] step of measured ranges, >= 0; 0: no quantisation
  /** [m] > 0: measured ranges of a phase-shift scanner are ambiguous by multiples of
   * this length; infinity: another type of scanner */
  double ambiguity_interval = std::numeric_limits<double>::infinity();
  double dropout = 0; ///< share of failed measurements, in [0, 1]
  /** [m] > 0: largest range of a white surface at perpendicular incidence; for other
   * surfaces times the root of the intensity */
  double signal_range = std::numeric_limits<double>::infinity();
  BeamOptions beam;

  std::uint64_t seed = 1;   ///< same seed, same noise
  unsigned num_threads = 0; ///< 0: one per core; never changes results

  /** \return equal range limits and seed without errors: one exact ray per sample */
  RangeOptions
  withoutErrors() const;

  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Hit of one ray of a beam on a surface. */
struct Echo {
  double range = 0;           ///< [m]
  double intensity = 0;       ///< reflectance times cosine of the incidence, in [0, 1]
  double cos_incidence = 1;   ///< in [0, 1]
  std::uint32_t triangle = 0; ///< of the scene
};

/** \brief One sample: measured values and the surface hit. */
struct RangeSample {
  double range = 0;           ///< [m] measured; NaN without return
  double intensity = 0;       ///< reflectance times cosine of the incidence, in [0, 1]
  std::uint32_t triangle = 0; ///< hit triangle of the scene; 0 without return
};

/** \brief Computes the measured range from the surfaces hit by a beam. Used by
 * castScan(). \ingroup scanner */
class RangeErrorModel {
public:
  /** \throws BadArgument see RangeOptions::validate() */
  explicit RangeErrorModel(const RangeOptions& options);

  /** \return the number of rays of a beam */
  int
  numRays() const
  {
    return static_cast<int>(spot_.size());
  }

  /** \return a ray of the beam; the rays fill the spot evenly, each with equal power.
   * \param[in] axis of the beam; also the ray of a beam with a single ray */
  Ray
  ray(const Ray& axis, int i) const;

  /** \return standard deviation of a range [m] */
  double
  sigma(double range, double intensity, double cos_incidence) const;

  /** \brief Measures once: mixes echoes, adds noise, applies ambiguity, quantisation,
   * dropout and limits. Draws a constant number of random numbers, independent of the
   * echoes.
   * \param[in] echoes of the rays that hit a surface, in any order */
  RangeSample
  measure(std::vector<Echo>& echoes, Random& random) const;

private:
  Echo
  strongestEcho(std::vector<Echo>& echoes) const;
  Echo
  mixed(const Echo* begin, const Echo* end) const;
  double
  mixedRange(const Echo* begin, const Echo* end) const;

  RangeOptions options_;
  std::vector<Eigen::Vector2d> spot_; // in the unit circle
  double spread_;                     // tangent of half the divergence
};

} // namespace pcl6d
