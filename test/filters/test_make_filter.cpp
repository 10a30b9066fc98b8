// SPDX-License-Identifier: BSD-3-Clause
// PCL's filters by the words of the command line.
#include "support/clouds.h"
#include "support/points.h"
#include "support/poses.h"

#include <pcl6d/filters/line_filter.h>
#include <pcl6d/filters/pcl/make_filter.h>

using namespace pcl6d; // NOLINT: the factory
using pcl6d::test::badArgumentOf;
using pcl6d::test::randomCube;
using pcl6d::test::toCloud;

namespace {
using Point = pcl::PointXYZI;

template <typename Class>
bool
is(const pcl::Filter<Point>::Ptr& made)
{
  return dynamic_cast<const Class*>(made.get()) != nullptr;
}
} // namespace

TEST(MakeFilter, GivesEachReductionByItsWord)
{
  Random random(1);
  const Points points = randomCube(random, 2000, 4);
  ReductionOptions options;
  options.voxel = 0.5;
  options.points_per_voxel = 2;
  options.seed = 7;
  for (const auto& name : reductionMethodNames()) {
    SCOPED_TRACE(name);
    const auto made = makeFilter<Point>(name, options);
    EXPECT_TRUE(is<OctreeReduction<Point>>(made));
    pcl::PointCloud<Point> found;
    made->setInputCloud(toCloud<Point>(points));
    made->filter(found);
    options.method = reductionMethodFromName(name);
    const Points expected = reducePoints(points, options);
    options.method = ReductionMethod::kMean;
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_EQ(found[i].getVector3fMap(), expected[i]);
  }
}

TEST(MakeFilter, GivesTheFiltersAlongLines)
{
  const auto median = makeFilter<Point>("scanline-median");
  EXPECT_TRUE(is<ScanLineMedian<Point>>(median));
  EXPECT_TRUE(is<ScanLineReduction<Point>>(makeFilter<Point>("scanline-reduction")));
  Points line(9, {8, 0, 0});
  line[4] = {4, 0, 0}; // a mixed pixel
  const auto cloud = toCloud<Point>(line);
  cloud->insert(cloud->end(), cloud->begin(), cloud->end());
  cloud->width = 9;
  cloud->height = 2;
  median->setInputCloud(cloud);
  pcl::PointCloud<Point> filtered;
  median->filter(filtered);
  ASSERT_EQ(filtered.size(), 18u);
  EXPECT_FLOAT_EQ(filtered[4].x, 8);
}

TEST(MakeFilter, RefusesWhatItDoesNotKnow)
{
  EXPECT_EQ(filterNames(),
            (std::vector<std::string>{
                "mean", "centre", "random", "scanline-median", "scanline-reduction"}));
  for (const std::string word : {"", "Mean", "scanline-both", "none"}) {
    const auto message = badArgumentOf([&] { makeFilter<Point>(word); });
    EXPECT_NE(message.find("mean|centre|random|scanline-median|scanline-reduction"),
              std::string::npos)
        << message;
  }
  ReductionOptions options;
  options.voxel = -1;
  EXPECT_NE(badArgumentOf([&] { makeFilter<Point>("mean", options); }), "");
}
