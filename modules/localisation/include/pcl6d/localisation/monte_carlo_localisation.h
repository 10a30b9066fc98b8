// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/random.h>
#include <pcl6d/localisation/segment_map.h>
#include <pcl6d/localisation/virtual_scan.h>

#include <Eigen/Geometry>

#include <cstdint>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of MonteCarloLocalisation. */
struct MclOptions {
  std::size_t num_particles = 200;   ///< while close together; > 0
  std::size_t max_particles = 20000; ///< while spread; >= num_particles

  /** standard deviations of the odometry, each >= 0: */
  double rotation_per_rotation = 0.1;     ///< [rad/rad]
  double rotation_per_metre = 0.01;       ///< [rad/m]
  double translation_per_metre = 0.05;    ///< [m/m]
  double translation_per_rotation = 0.05; ///< [m/rad]
  double start_position = 0.3;            ///< [m] of a given start
  double start_yaw = 0.05;                ///< [rad] of a given start

  double hit_sigma = 0.2;         ///< [m] of a point about its wall; > 0
  double hit_share = 0.9;         ///< of the points on a wall of the map; (0, 1)
  double beam_independence = 0.2; ///< kappa: how much of a point is news; (0, 1]

  std::size_t min_walls = 10;      ///< least wall points of a usable scan
  double agreement_distance = 0.5; ///< [m] a point agrees with the map; > 0
  double min_agreement = 0.5;      ///< least share of agreeing points; in [0, 1]
  double max_spread = 0.5;     ///< [m] standard deviation of a trusted position; > 0
  double max_yaw_spread = 0.1; ///< [rad] and of its heading; > 0
  std::size_t min_stretch = 3; ///< trusted scans in a row; shorter stretches are not

  std::uint64_t seed = 1;
  unsigned int num_threads = 0; ///< 0: a thread per core; never changes the result
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Reason why a pose is doubtful. */
enum class MclDoubt {
  kNone,
  kFewWalls,     ///< fewer than min_walls wall points
  kDisagreement, ///< too few wall points agree with the map
  kSpread,       ///< the particles are spread too far
  kShortStretch  ///< trusted for fewer than min_stretch scans in a row
};

/** \return "", "few walls", "off the map", "spread" or "short stretch" */
const char*
toString(MclDoubt doubt);

/** \brief Where a scan was taken, in the plan. */
struct MclEstimate {
  Eigen::Vector3d pose = Eigen::Vector3d::Zero();       ///< x, y [m], yaw [rad]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero(); ///< of x, y, yaw [m, rad]
  std::size_t walls = 0;     ///< wall points of the virtual scan
  double agreement = 0;      ///< share of wall points within
                             ///< agreement_distance of the map
  std::size_t particles = 0; ///< number of moved particles
  MclDoubt doubt = MclDoubt::kNone;

  bool
  trusted() const
  {
    return doubt == MclDoubt::kNone;
  }
};

/** \brief Finds the way of a robot in a known plan by a particle filter (book 6.4.2).
 *
 * Each scan moves the particles by the odometry with its errors, weighs them by how the virtual
 * scan fits the plan, log w += kappa sum_k log(z_hit exp(-d_k^2 / 2 sigma^2) + z_rand), and
 * resamples (low variance) when the weights have become unequal. The estimate is the weighted mean.
 * The number of particles follows from their spread (Fox 2003).
 *
 * Quality control marks the scans with doubtful poses, with a reason (MclDoubt). A scan with too
 * few walls, or without a fit to the plan at any particle, does not change the weights: the
 * particles move and spread until the plan is seen again.
 *
 * Bit-identical for any number of threads and any CPU.
 * \note Source: S. Thrun, D. Fox, W. Burgard, F. Dellaert, "Robust Monte Carlo
 * localization for mobile robots", Artificial Intelligence 128, 2001; D. Fox, "Adapting
 * the sample size in particle filters through KLD-sampling", IJRR 22(12), 2003.
 * \ingroup localisation */
class MonteCarloLocalisation {
public:
  /** \brief Starts at a known pose, or anywhere in the plan; in the latter case set max_particles
   * to about 50 per m^2. Keeps a reference to the map.
   * \param[in] start x, y [m, relative to map.offset()], yaw [rad], of the first scan
   * \throws BadArgument an option is invalid, or the start is not finite */
  MonteCarloLocalisation(const SegmentMap& map,
                         const std::optional<Eigen::Vector3d>& start,
                         const MclOptions& options = MclOptions());

  /** \brief Goes on to the next scan.
   * \param[in] motion since the scan before, in its levelled frame: x, y [m], yaw [rad];
   * zero for the first scan
   * \return the estimate; kShortStretch is not yet decided
   * \throws BadArgument the motion is not finite */
  MclEstimate
  addScan(const Eigen::Vector3d& motion, const VirtualScan& scan);

private:
  struct Particle {
    Eigen::Vector3d pose;
    double log_weight = 0;
    std::size_t agreeing = 0; ///< points of the scan
  };
  void
  move(const Eigen::Vector3d& motion);
  void
  weigh(const VirtualScan& scan);
  void
  resample();
  std::size_t
  wantedParticles() const;
  std::vector<double>
  weights() const;
  void
  estimate(MclEstimate& result) const;
  std::size_t
  agreeing(const Eigen::Vector3d& pose, const VirtualScan& scan) const;
  MclDoubt
  doubtOf(const MclEstimate& result) const;

  const SegmentMap& map_;
  MclOptions options_;
  Random random_;
  std::vector<Particle> particles_;
  bool has_moved_ = false;
};

/** \return the motion between two scans in the levelled frame of the first: x, y [m], yaw
 * [rad]
 * \param[in] T_a_b the motion measured by the odometry
 * \param[in] R_level_a, R_level_b roll and pitch of the scans; see levelByWalls() */
Eigen::Vector3d
planarMotion(const Eigen::Isometry3d& T_a_b,
             const Eigen::Matrix3d& R_level_a,
             const Eigen::Matrix3d& R_level_b);

/** \brief Marks trusted stretches of too few scans in a row with kShortStretch, unless the stretch
 * is the whole drive. */
void
distrustShortStretches(std::vector<MclEstimate>& estimates, std::size_t min_stretch);

} // namespace pcl6d
