// SPDX-License-Identifier: BSD-3-Clause
#include "plane_search.h"

namespace pcl6d {

Support
PlaneSearch::supportOf(const Slab& guess) const
{
  Support support = findSupport(points_, guess, support_);
  if (support.slots.size() < min_points_)
    support.slots.clear();
  return support;
}

bool
PlaneSearch::take(const Support& support)
{
  const bool flat = !isCurved(points_.columns(), support);
  if (flat)
    found_.push_back(points_.places(support.slots));
  points_.remove(support.slots);
  return flat;
}

} // namespace pcl6d
