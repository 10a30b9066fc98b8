// SPDX-License-Identifier: BSD-3-Clause
#include "icp_cases.h"

#include <pcl6d/search/point_list.h>

#include <atomic>
#include <memory>

using namespace pcl6d; // NOLINT: the whole API of ICP
using pcl6d::test::badArgumentOf;
using pcl6d::test::corner;
using pcl6d::test::kExactSearches;
using pcl6d::test::kTruth;
using pcl6d::test::Surface;

TEST(IcpModel, FindsTheSamePoseApproximately)
{
  Random random(8);
  const Surface scene = corner(random, 3000, 2, 0.002);
  const IcpModel model = scene.model(SearchMethod::kApproximate);
  const IcpModel data = scene.moved(kTruth.inverse()).model();
  const IcpResult result =
      icp({model.part()}, data.source(), Eigen::Isometry3d::Identity(), {});
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_LT(distanceBetween(kTruth, result.T_target_source).translation, 1e-3);
}

TEST(IcpModel, EstimatesNormalsOrTakesThem)
{
  Random random(9);
  const Surface scene = corner(random, 900, 2);
  IcpModel::Options options;
  const IcpModel without(scene.points, options);
  EXPECT_TRUE(without.normals().empty());
  EXPECT_EQ(without.source().normals, nullptr);
  EXPECT_EQ(without.part().normals, nullptr);
  options.normals = true;
  const IcpModel with(scene.points, options);
  const Normals expected =
      estimateNormals(scene.points, with.tree(), options.neighbours);
  ASSERT_EQ(with.normals().size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_TRUE(test::sameBits(with.normals()[i], expected[i]));
  EXPECT_EQ(with.part().normals, &with.normals());
  EXPECT_EQ(with.source().points, &with.points());
}

TEST(IcpModel, RefusesBadOptions)
{
  const Points points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const std::size_t neighbours : {0u, 2u, 65u}) {
    IcpModel::Options options;
    options.neighbours = neighbours;
    options.normals = true;
    EXPECT_THROW(IcpModel(points, options), BadArgument);
  }
  EXPECT_THROW(IcpModel(points, Normals(2, {0, 0, 1}), {}), BadArgument);
  EXPECT_THROW(IcpModel(points, Normals(), {}), BadArgument);
}

TEST(IcpModel, OutlivesCopiesAndMoves)
{
  Random random(10);
  const Surface scene = corner(random, 600, 2, 0.01);
  const IcpModel data = scene.moved(kTruth.inverse()).model();
  for (const SearchMethod search : kExactSearches) {
    auto first = std::make_unique<IcpModel>(scene.model(search));
    const IcpModel copy = *first;
    const IcpResult expected =
        icp({first->part()}, data.source(), Eigen::Isometry3d::Identity(), {});
    const IcpModel taken = std::move(*first);
    first.reset();
    for (const IcpModel* model : {&copy, &taken})
      EXPECT_TRUE(test::sameBits(
          icp({model->part()}, data.source(), Eigen::Isometry3d::Identity(), {})
              .T_target_source,
          expected.T_target_source));
  }
}

TEST(IcpModel, TakesASearchOfTheCaller)
{
  Random random(11);
  const Surface scene = corner(random, 900, 2, 0.01);
  const IcpModel data = scene.moved(kTruth.inverse()).model();
  std::size_t made = 0;
  std::atomic<std::size_t> asked = 0; // by several threads
  IcpModel::Options options;
  options.make_search = [&](const Points& points) -> NearestSearch {
    ++made;
    return [&asked, list = PointList(points)](const Eigen::Vector3f& p, float limit) {
      ++asked;
      return list.nearest(p, limit);
    };
  };
  const IcpModel model(scene.points, options);
  const IcpResult found =
      icp({model.part()}, data.source(), Eigen::Isometry3d::Identity(), {});
  const IcpModel brute = scene.model(SearchMethod::kBruteForce);
  const IcpResult expected =
      icp({brute.part()}, data.source(), Eigen::Isometry3d::Identity(), {});
  EXPECT_TRUE(test::sameBits(found.T_target_source, expected.T_target_source));
  EXPECT_EQ(made, 1u);
  EXPECT_GE(asked, scene.points.size());
  options.make_search = [](const Points&) { return NearestSearch(); };
  EXPECT_THROW(IcpModel(scene.points, options), BadArgument);
}

/** Two sheets of a grid with the source half-way between them: each point has two or more
 * nearest ones at the same distance. Any of them is right; the distances are the same. */
TEST(SearchMethod, FlannFindsPointsAsNearWhereSeveralAreNearest)
{
  Points grid, between;
  for (int x = 0; x < 12; ++x)
    for (int y = 0; y < 12; ++y) {
      for (const float z : {0.0f, 0.5f})
        grid.push_back({static_cast<float>(x) / 4, static_cast<float>(y) / 4, z});
      between.push_back({static_cast<float>(x) / 4, static_cast<float>(y) / 4, 0.25f});
    }
  IcpModel::Options options;
  options.search = SearchMethod::kFlann;
  const IcpModel flann(grid, options);
  options.search = SearchMethod::kBruteForce;
  const IcpModel brute(grid, options);
  for (const Eigen::Vector3f& p : between) {
    const Neighbour found = flann.part().search(p, 1);
    ASSERT_GE(found.index, 0);
    EXPECT_EQ(found.distance_sq, brute.part().search(p, 1).distance_sq);
    EXPECT_EQ(found.distance_sq,
              distanceSq(p, grid[static_cast<std::size_t>(found.index)]));
  }
}

TEST(SearchMethod, HasNames)
{
  EXPECT_EQ(searchMethodNames(),
            (std::vector<std::string>{"kdtree",
                                      "cached-tree",
                                      "remembered",
                                      "approximate",
                                      "octree",
                                      "brute-force",
                                      "flann"}));
  for (const auto& name : searchMethodNames())
    EXPECT_EQ(toString(searchMethodFromName(name)), name);
  const std::string message = badArgumentOf([] { searchMethodFromName("annoy"); });
  for (const auto& name : searchMethodNames())
    EXPECT_NE(message.find(name), std::string::npos) << message;
  EXPECT_EQ(searchMethodFromName("cached"), SearchMethod::kRemembered) << "as it was";
}
