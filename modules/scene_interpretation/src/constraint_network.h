// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

/** \file The constraint network of book 7.1.2, without geometry: variables that take
 * one of several values, or no value. Internal to the module scene_interpretation. */
namespace pcl6d::scene_interpretation {

/** \brief A possible value of a variable. */
struct NetworkValue {
  std::size_t variable = 0;
  std::size_t label = 0;              ///< of the caller
  std::vector<std::size_t> conflicts; ///< incompatible values; symmetric
  /// for each need, the values of possible partners; at least one must be chosen
  std::vector<std::vector<std::size_t>> needs;
};

/** \brief Values are sorted by variable, and by preference within a variable. */
struct ConstraintNetwork {
  std::vector<std::int64_t> worth; ///< per variable, >= 0: of having a value
  std::vector<NetworkValue> values;
};

struct NetworkSolution {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> chosen; ///< per variable the index of its value, or kNone
  std::int64_t worth = 0;
  std::size_t nodes = 0;   ///< assignments tried
  bool is_complete = true; ///< false: the node limit was reached; best solution up to
                           ///< then
};

/** \brief Finds the consistent choice of the largest worth. Of several the first is
 * returned: variables are compared by falling worth (ties: the lower index), values by
 * preference, no value last. Branch and bound, for each component of the network
 * separately. \param[in] node_limit of the components together */
NetworkSolution
solve(const ConstraintNetwork& network, std::size_t node_limit);

} // namespace pcl6d::scene_interpretation
