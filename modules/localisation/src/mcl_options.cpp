// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/localisation/monte_carlo_localisation.h>

#include <cmath>

namespace pcl6d {

void
MclOptions::validate() const
{
  require(num_particles > 0, "num_particles", num_particles, "> 0");
  require(max_particles >= num_particles,
          "max_particles",
          max_particles,
          ">= num_particles, " + std::to_string(num_particles));
  const auto requireSigma = [](const char* name, double value) {
    require(std::isfinite(value) && value >= 0, name, value, "finite and >= 0");
  };
  requireSigma("rotation_per_rotation", rotation_per_rotation);
  requireSigma("rotation_per_metre", rotation_per_metre);
  requireSigma("translation_per_metre", translation_per_metre);
  requireSigma("translation_per_rotation", translation_per_rotation);
  requireSigma("start_position", start_position);
  requireSigma("start_yaw", start_yaw);
  const auto requirePositive = [](const char* name, double value) {
    require(std::isfinite(value) && value > 0, name, value, "finite and > 0");
  };
  requirePositive("hit_sigma", hit_sigma);
  require(hit_share > 0 && hit_share < 1, "hit_share", hit_share, "in (0, 1)");
  require(beam_independence > 0 && beam_independence <= 1,
          "beam_independence",
          beam_independence,
          "in (0, 1]");
  requirePositive("agreement_distance", agreement_distance);
  require(min_agreement >= 0 && min_agreement <= 1,
          "min_agreement",
          min_agreement,
          "in [0, 1]");
  requirePositive("max_spread", max_spread);
  requirePositive("max_yaw_spread", max_yaw_spread);
}

const char*
toString(MclDoubt doubt)
{
  constexpr Named<MclDoubt> kDoubts[] = {{MclDoubt::kFewWalls, "few walls"},
                                         {MclDoubt::kDisagreement, "off the map"},
                                         {MclDoubt::kSpread, "spread"},
                                         {MclDoubt::kShortStretch, "short stretch"}};
  return nameOf(kDoubts, doubt, "");
}

Eigen::Vector3d
planarMotion(const Eigen::Isometry3d& T_a_b,
             const Eigen::Matrix3d& R_level_a,
             const Eigen::Matrix3d& R_level_b)
{
  const Eigen::Vector3d way = R_level_a * T_a_b.translation();
  const Eigen::Matrix3d turn = R_level_a * T_a_b.linear() * R_level_b.transpose();
  return {way.x(), way.y(), eulerFromRotation(turn).yaw};
}

void
distrustShortStretches(std::vector<MclEstimate>& estimates, std::size_t min_stretch)
{
  for (std::size_t begin = 0; begin < estimates.size();) {
    std::size_t end = begin;
    while (end < estimates.size() && estimates[end].trusted())
      ++end;
    const bool is_whole = begin == 0 && end == estimates.size();
    if (end - begin < min_stretch && !is_whole)
      for (std::size_t i = begin; i < end; ++i)
        estimates[i].doubt = MclDoubt::kShortStretch;
    begin = end + 1;
  }
}

} // namespace pcl6d
