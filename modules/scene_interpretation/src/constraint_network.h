// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

/** \file The constraint network of book 7.1.2, free of geometry: variables that may
 * take one of several values, or none. Internal to the module scene_interpretation. */
namespace pcl6d::scene_interpretation {

/** \brief A possible value of a variable. */
struct NetworkValue {
  std::size_t variable = 0;
  std::size_t label = 0;              ///< of the caller
  std::vector<std::size_t> conflicts; ///< values it cannot stand beside; symmetric
  /// for each need, the values of which at least one must stand beside it
  std::vector<std::vector<std::size_t>> needs;
};

/** \brief Values are sorted by variable; those of one variable by preference. */
struct ConstraintNetwork {
  std::vector<std::int64_t> worth; ///< per variable, >= 0: of having a value
  std::vector<NetworkValue> values;
};

struct NetworkSolution {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> chosen; ///< per variable the place of its value, or kNone
  std::int64_t worth = 0;
  std::size_t nodes = 0;   ///< assignments tried
  bool is_complete = true; ///< false: the node limit was reached; the best found so far
};

/** \brief The consistent choice of the largest worth; of several the first, where
 * variables are compared by falling worth (ties: the lower place), values by
 * preference, none last. Branch and bound, apart for each component of the network.
 * \param[in] node_limit of all components together */
NetworkSolution
solve(const ConstraintNetwork& network, std::size_t node_limit);

} // namespace pcl6d::scene_interpretation
