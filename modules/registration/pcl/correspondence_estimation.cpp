// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/parallel.h>
#include <pcl6d/registration/pcl/correspondence_estimation.h>

#include <cmath>

namespace pcl6d {
namespace registration {

float
limitThatIncludes(double max_distance)
{
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  const double sq = max_distance * max_distance;
  if (!(sq < static_cast<double>(std::numeric_limits<float>::max())))
    return kInfinite;
  float last = static_cast<float>(sq); // the largest still included
  if (static_cast<double>(last) > sq)
    last = std::nextafter(last, 0.0f);
  return std::nextafter(last, kInfinite);
}

void
findClosest(const PointTree& tree,
            const Points& points,
            const Points& queries,
            float limit_sq,
            unsigned int num_threads,
            std::vector<Neighbour>& found)
{
  constexpr std::size_t kQueries =
      512; // few for a thread to wait for, many for the loop
  found.resize(queries.size());
  parallelBlocks(queries.size(), kQueries, num_threads, [&](const Block& block) {
    int last = -1; // scans come in order: the neighbour of the last point is near
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const int likely = found[i].index >= 0 ? found[i].index : last;
      found[i] = likely < 0 ? tree.nearest(queries[i], limit_sq)
                            : tree.nearest(queries[i],
                                           limit_sq,
                                           likely,
                                           points[static_cast<std::size_t>(likely)]);
      if (found[i].index >= 0)
        last = found[i].index;
    }
  });
}

} // namespace registration

PCL6D_DEFINE_PAIR_INSTANCES(CorrespondenceEstimation)
} // namespace pcl6d
