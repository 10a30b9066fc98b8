// SPDX-License-Identifier: BSD-3-Clause
// The search classes where PCL's stand, with what their constructors and setters take.
#include "support/clouds.h"
#include "support/points.h"
#include "support/poses.h"

#include <pcl6d/search/pcl/brute_force_search.h>
#include <pcl6d/search/pcl/cached_kd_tree.h>
#include <pcl6d/search/pcl/octree_search.h>

#include <pcl/point_representation.h>
#include <pcl/search/brute_force.h>
#include <pcl/search/octree.h>

#include <type_traits>

using pcl6d::Random;
using pcl6d::test::toCloud;

namespace {
using Point = pcl::PointXYZ;

pcl6d::Points
points(std::size_t count)
{
  Random random(4);
  pcl6d::Points made;
  for (std::size_t i = 0; i < count; ++i)
    made.emplace_back(random.uniform(0, 4), random.uniform(0, 4), random.uniform(0, 4));
  return made;
}

/** Heights count five times. */
struct Steep : pcl::PointRepresentation<Point> {
  Steep() { nr_dimensions_ = 3; }
  void
  copyToFloatArray(const Point& p, float* out) const override
  {
    out[0] = p.x;
    out[1] = p.y;
    out[2] = 5 * p.z;
  }
};

/** pcl::search::Search as PCL 1.14 and later have it, as far as CoreSearch needs it. */
struct NewerSearch {
  using PointCloudConstPtr = pcl::PointCloud<Point>::ConstPtr;
  virtual ~NewerSearch() = default;
  virtual bool
  setInputCloud(const PointCloudConstPtr& cloud,
                const pcl::IndicesConstPtr& indices) = 0;
  virtual int
  nearestKSearch(const Point&, int, pcl::Indices&, std::vector<float>&) const = 0;
  virtual int
  radiusSearch(const Point&, double, pcl::Indices&, std::vector<float>&, unsigned int)
      const = 0;

protected:
  std::string name_;
  bool sorted_results_ = false;
  PointCloudConstPtr input_;
  pcl::IndicesConstPtr indices_;
};

class NewerKdTree : public pcl6d::CoreSearch<Point, pcl6d::PointTree, NewerSearch> {
public:
  NewerKdTree() : CoreSearch("newer") {}

protected:
  std::shared_ptr<const pcl6d::PointTree>
  build(const pcl6d::Points& points) override
  {
    return std::make_shared<pcl6d::PointTree>(points);
  }
};
} // namespace

TEST(SearchAsPcl, IsConstructedAsPclsClasses)
{
  const auto cloud = toCloud<Point>(points(500));
  const pcl::search::Search<Point>::Ptr of_pcl(new pcl::search::Octree<Point>(128.0));
  const pcl::search::Search<Point>::Ptr ours[] = {
      pcl::search::Search<Point>::Ptr(new pcl6d::OctreeSearch<Point>(128.0)),
      pcl::search::Search<Point>::Ptr(new pcl6d::KdTree<Point>(true)),
      pcl::search::Search<Point>::Ptr(new pcl6d::CachedKdTree<Point>(false)),
      pcl::search::Search<Point>::Ptr(new pcl6d::BruteForceSearch<Point>(true))};
  of_pcl->setInputCloud(cloud);
  pcl::Indices expected, found;
  std::vector<float> distances;
  of_pcl->nearestKSearch({1, 2, 3}, 4, expected, distances);
  for (const auto& search : ours) {
    search->setInputCloud(cloud);
    search->nearestKSearch({1, 2, 3}, 4, found, distances);
    EXPECT_EQ(found, expected) << search->getName();
  }
}

TEST(SearchAsPcl, TakesNoNumberOfThreadsWherePclTakesABool)
{
  static_assert(!std::is_constructible<pcl6d::KdTree<Point>, unsigned>::value, "");
  static_assert(!std::is_constructible<pcl6d::CachedKdTree<Point>, int>::value, "");
  static_assert(std::is_constructible<pcl6d::KdTree<Point>, bool>::value, "");
}

TEST(SearchAsPcl, HonoursARepresentationOfPoints)
{
  const auto cloud = toCloud<Point>(points(500));
  pcl::search::KdTree<Point> of_pcl;
  of_pcl.setPointRepresentation(pcl::make_shared<Steep>());
  of_pcl.setInputCloud(cloud);
  pcl6d::KdTree<Point> plain, before, after;
  pcl6d::CachedKdTree<Point> cached;
  pcl6d::KdTree<Point> by_base;
  before.setPointRepresentation(pcl::make_shared<Steep>());
  cached.setPointRepresentation(pcl::make_shared<Steep>());
  static_cast<pcl::search::KdTree<Point>&>(by_base).setPointRepresentation(
      pcl::make_shared<Steep>());
  for (auto* tree :
       {&plain, &before, &after, static_cast<pcl6d::KdTree<Point>*>(&cached), &by_base})
    tree->setInputCloud(cloud);
  after.setPointRepresentation(pcl::make_shared<Steep>());
  int differ = 0;
  for (int i = 0; i < 100; ++i) {
    pcl::Indices expected, found;
    std::vector<float> expected_sq, found_sq;
    const Point query{0.04f * i, 4 - 0.04f * i, 2};
    of_pcl.nearestKSearch(query, 1, expected, expected_sq);
    plain.nearestKSearch(query, 1, found, found_sq);
    differ += found != expected ? 1 : 0;
    for (auto* tree :
         {&before, &after, static_cast<pcl6d::KdTree<Point>*>(&cached), &by_base}) {
      tree->nearestKSearch(query, 1, found, found_sq);
      EXPECT_EQ(found, expected) << i;
      EXPECT_EQ(found_sq, expected_sq) << i;
    }
    EXPECT_EQ(before.radiusSearch(query, 1.5, found, found_sq),
              of_pcl.radiusSearch(query, 1.5, expected, expected_sq));
  }
  EXPECT_GT(differ, 20) << "so it matters";
}

TEST(SearchAsPcl, FitsTheInterfaceOfNewerPcl)
{
  const auto cloud = toCloud<Point>(points(50));
  NewerKdTree tree;
  const bool is_set = tree.setInputCloud(cloud);
  EXPECT_TRUE(is_set);
  pcl::Indices found;
  std::vector<float> distances;
  EXPECT_EQ(tree.nearestKSearch((*cloud)[7], 1, found, distances), 1);
  EXPECT_EQ(found[0], 7);
}
