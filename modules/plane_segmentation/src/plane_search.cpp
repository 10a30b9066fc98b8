// SPDX-License-Identifier: BSD-3-Clause
#include "plane_search.h"

namespace pcl6d {

Support
PlaneSearch::supportOf(const Slab& guess) const
{
  Support support = findSupport(surfels_, guess);
  if (support.slots.size() < min_surfels_)
    support.slots.clear();
  return support;
}

bool
PlaneSearch::take(const Support& support)
{
  const bool flat = !isCurved(surfels_.columns(), support);
  if (flat)
    found_.push_back(surfels_.pointsOf(support.slots));
  surfels_.remove(support.slots);
  return flat;
}

} // namespace pcl6d
