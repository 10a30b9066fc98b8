// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/object_localization/normal_orientation.h>

#include <algorithm>
#include <numeric>
#include <queue>

namespace pcl6d {

namespace {
using Index = std::uint32_t;

/** An edge of the graph, from a point with oriented normal. */
struct Edge {
  float turn; // 1 - |cosine| of the normals
  Index to;
  Index from;

  friend bool
  operator>(const Edge& a, const Edge& b)
  {
    return std::tie(a.turn, a.to, a.from) > std::tie(b.turn, b.to, b.from);
  }
};

/** Spreads agreement from settled points (Prim's algorithm). */
class Spreading {
public:
  Spreading(Normals& normals,
            const Points& points,
            const PointTree& tree,
            std::size_t neighbours)
  : normals_(normals)
  , points_(points)
  , tree_(tree)
  , near_(neighbours)
  , settled_(points.size(), false)
  {}

  bool
  isSettled(Index i) const
  {
    return settled_[i];
  }

  /** \return the points of the surface that contains the seed */
  std::vector<Index>
  from(Index seed)
  {
    std::vector<Index> surface;
    settle(seed, surface);
    while (!edges_.empty()) {
      const Edge edge = edges_.top();
      edges_.pop();
      if (settled_[edge.to])
        continue;
      if (normals_[edge.to].dot(normals_[edge.from]) < 0)
        normals_[edge.to] = -normals_[edge.to];
      settle(edge.to, surface);
    }
    return surface;
  }

private:
  void
  settle(Index i, std::vector<Index>& surface)
  {
    settled_[i] = true;
    surface.push_back(i);
    const std::size_t count = tree_.nearestK(points_[i], near_.size(), near_.data());
    for (std::size_t k = 0; k < count; ++k) {
      const auto j = static_cast<Index>(near_[k].index);
      if (!settled_[j] && normals_[j].squaredNorm() > 0)
        edges_.push({1 - std::abs(normals_[i].dot(normals_[j])), j, i});
    }
  }

  Normals& normals_;
  const Points& points_;
  const PointTree& tree_;
  std::vector<Neighbour> near_;
  std::vector<bool> settled_;
  std::priority_queue<Edge, std::vector<Edge>, std::greater<Edge>> edges_;
};

/** Flips the normals of a surface if they point to its centroid. Points weigh by their
 * distance: the outermost, far from folds, decide. */
void
turnOutwards(Normals& normals, const Points& points, const std::vector<Index>& surface)
{
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Index i : surface)
    middle += points[i].cast<double>() / static_cast<double>(surface.size());
  double outwards = 0;
  for (const Index i : surface) {
    const Eigen::Vector3d arm = points[i].cast<double>() - middle;
    outwards += arm.norm() * arm.dot(normals[i].cast<double>());
  }
  if (outwards < 0)
    for (const Index i : surface)
      normals[i] = -normals[i];
}
} // namespace

void
orientNormals(Normals& normals,
              const Points& points,
              const PointTree& tree,
              std::size_t neighbours)
{
  if (normals.size() != points.size())
    throw BadArgument(std::to_string(normals.size()) + " normals for " +
                      std::to_string(points.size()) + " points");
  require(neighbours >= 3 && neighbours <= 64, "neighbours", neighbours, "3 to 64");
  Spreading spreading(normals, points, tree, neighbours);
  for (Index i = 0; i < points.size(); ++i)
    if (!spreading.isSettled(i) && normals[i].squaredNorm() > 0)
      turnOutwards(normals, points, spreading.from(i));
}

} // namespace pcl6d
