// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/random.h>
#include <pcl6d/filters/voxel_reduction.h>

#include <pcl/types.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace pcl6d::filters {

/** \brief Appends at most `wanted` of the members, ascending, chosen by random bits: a partial
 * shuffle of Fisher and Yates. */
inline void
appendRandom(const IndexRange& of,
             std::size_t wanted,
             std::uint64_t bits,
             pcl::Indices& chosen)
{
  pcl::Indices members(of.begin(), of.end());
  if (members.size() > wanted) {
    for (std::size_t i = 0; i < wanted; ++i) {
      bits = mixBits(bits);
      std::swap(members[i], members[i + bits % (members.size() - i)]);
    }
    members.resize(wanted);
    std::sort(members.begin(), members.end());
  }
  chosen.insert(chosen.end(), members.begin(), members.end());
}

} // namespace pcl6d::filters
