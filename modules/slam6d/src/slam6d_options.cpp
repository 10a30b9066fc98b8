// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/filters/scan_parameters.h>
#include <pcl6d/slam6d/slam6d_options.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace pcl6d {

void
Slam6DOptions::validate() const
{
  ScanParameterOptions{min_range, max_range, voxel, line_spacing}.validate();
  require(reduction_points >= 1, "reduction_points", reduction_points, ">= 1");
  require(!max_distance || (*max_distance > 0 && std::isfinite(*max_distance)),
          "max_distance",
          max_distance.value_or(0),
          "finite and > 0");
  require(!max_distance_start ||
              (*max_distance_start >= 0 && std::isfinite(*max_distance_start)),
          "max_distance_start",
          max_distance_start.value_or(0),
          "finite and >= 0");
  require(!max_distance_start || *max_distance_start == 0 || !max_distance ||
              *max_distance_start >= *max_distance,
          "max_distance_start",
          max_distance_start.value_or(0),
          "0 or at least max_distance");
  require(metascan >= 0, "metascan", metascan, ">= 0");
  require(minimiser != nullptr, "minimiser", "none", "a function");
  require(plane_minimiser != nullptr, "plane_minimiser", "none", "a function");
  require(max_iterations > 0, "max_iterations", max_iterations, "> 0");
  require(!translation_epsilon || *translation_epsilon >= 0,
          "translation_epsilon",
          translation_epsilon.value_or(0),
          ">= 0");
  require(rotation_epsilon >= 0, "rotation_epsilon", rotation_epsilon, ">= 0");
  require(
      min_overlap >= 0 && min_overlap <= 1, "min_overlap", min_overlap, "in [0, 1]");
  for (const auto& [distance, name] : {std::pair(loop_distance, "loop_distance"),
                                       std::pair(link_distance, "link_distance")})
    require(!distance || (*distance > 0 && std::isfinite(*distance)),
            name,
            distance.value_or(0),
            "finite and > 0");
  for (const auto& [count, name] :
       {std::pair(loop_gap, "loop_gap"), std::pair(loop_pairs, "loop_pairs")})
    require(!count || (*count > 0 && *count == std::floor(*count) && *count < 1e9),
            name,
            count.value_or(0),
            "a whole number > 0");
  require(loop_gate > 0, "loop_gate", loop_gate, "> 0");
  require(link_hysteresis >= 0 && link_hysteresis < 1,
          "link_hysteresis",
          link_hysteresis,
          "in [0, 1)");
  require(relaxation_rounds > 0, "relaxation_rounds", relaxation_rounds, "> 0");
  motion.validate();
  require(max_correction >= 0, "max_correction", max_correction, ">= 0");
}

} // namespace pcl6d
