// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/random.h>
#include <pcl6d/scanner/ray.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The spot of light of one measurement; the defaults make it a point. */
struct BeamOptions {
  double exit_diameter = 0; ///< [m] where it leaves the scanner, >= 0
  double divergence = 0;    ///< [rad] full angle, in [0, pi / 2]
  int rays = 1;             ///< that stand for the spot, in [1, 1000]; 1: its axis only
  /** [m] >= 0: surfaces in one spot at most this far apart (from one to the next) give a
   * single echo at a range between them, a mixed pixel: half the length of a pulse; of
   * several echoes the strongest counts */
  double echo_separation = std::numeric_limits<double>::infinity();
};

/** \brief How a scanner measures ranges (book 2.1); the defaults add constant noise and
 * nothing else. */
struct RangeOptions {
  double noise = 0.01;    ///< [m] standard deviation of a range, >= 0
  double min_range = 0.2; ///< [m] shorter ranges are no return; >= 0
  double max_range = 30;  ///< [m] longer ranges are no return; > min_range

  /// \name Further noise, independent of `noise` and of each other; all >= 0
  ///@{
  double noise_per_range = 0; ///< [m/m] times the range: time of flight over far ways
  double noise_per_range_sq =
      0;                      ///< [1/m] times its square: triangulation, 1 / (b f) px
  double incidence_noise = 0; ///< [m] times the tangent of the angle of incidence
  double signal_noise = 0;    ///< [m] over the root of the intensity: dark surfaces
  ///@}

  double quantum = 0; ///< [m] measured ranges are multiples of it, >= 0; 0: any number
  /** [m] > 0: a phase-shift scanner cannot tell ranges apart that differ by multiples of
   * it; infinity: no such scanner */
  double ambiguity_interval = std::numeric_limits<double>::infinity();
  double dropout = 0; ///< share of measurements that fail, in [0, 1]
  /** [m] > 0: how far a white surface hit squarely is seen, others by the root of their
   * intensity less far */
  double signal_range = std::numeric_limits<double>::infinity();
  BeamOptions beam;

  std::uint64_t seed = 1;   ///< same seed, same noise
  unsigned num_threads = 0; ///< 0: one per core; never changes results

  /** \return the same range limits and seed without any error: one exact ray a sample */
  RangeOptions
  withoutErrors() const;

  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief What one ray of a beam met. */
struct Echo {
  double range = 0;           ///< [m]
  double intensity = 0;       ///< reflectance times cosine of the incidence, in [0, 1]
  double cos_incidence = 1;   ///< in [0, 1]
  std::uint32_t triangle = 0; ///< of the scene
};

/** \brief One sample: what the scanner says and what it looked at. */
struct RangeSample {
  double range = 0;           ///< [m] measured; NaN if there was no return
  double intensity = 0;       ///< reflectance times cosine of the incidence, in [0, 1]
  std::uint32_t triangle = 0; ///< hit triangle of the scene; 0 if there was no return
};

/** \brief From the surfaces that a beam meets to the range that the scanner tells. Used
 * by castScan(). \ingroup scanner */
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

  /** \return a ray of the beam; they fill its spot evenly, each with equal power.
   * \param[in] axis of the beam; with a single ray, that ray */
  Ray
  ray(const Ray& axis, int i) const;

  /** \return standard deviation of a range [m] */
  double
  sigma(double range, double intensity, double cos_incidence) const;

  /** \brief Measures once: mixes echoes, adds noise, applies ambiguity, quantisation,
   * dropout and limits. Takes the same random numbers whatever there is to see.
   * \param[in] echoes of those rays of the beam that met a surface, in any order */
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
