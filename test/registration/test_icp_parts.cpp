// SPDX-License-Identifier: BSD-3-Clause
// A target of many parts is the union of the parts.
#include "icp_cases.h"
#include "support/constants.h"

using namespace pcl6d; // NOLINT: the whole API of ICP
using pcl6d::test::corner;
using pcl6d::test::expectSameTrace;
using pcl6d::test::kAllMetrics;
using pcl6d::test::kIdentity;
using pcl6d::test::kNan;
using pcl6d::test::kTruth;
using pcl6d::test::sameBits;
using pcl6d::test::Surface;
using pcl6d::test::Trace;
using pcl6d::test::traceOf;

namespace {

/** A room corner, cut into parts, each in a frame of its own. */
struct Puzzle {
  Surface whole; ///< in the target's frame
  std::vector<Eigen::Isometry3d> poses;
  std::vector<IcpModel> models;

  Puzzle(Random& random,
         std::size_t count,
         double extent,
         SearchMethod search = SearchMethod::kRemembered)
  {
    whole = corner(random, 1800, 2, 0.01);
    std::vector<Surface> parts(count);
    for (std::size_t i = 0; i < whole.points.size(); ++i)
      parts[i * 7919 % count].add(whole.points[i].cast<double>(),
                                  whole.normals[i].cast<double>());
    for (const Surface& part : parts) {
      poses.push_back(test::randomPose(random, extent, 2));
      models.push_back(part.moved(poses.back().inverse()).model(search));
    }
  }
  IcpTarget
  target() const
  {
    IcpTarget parts;
    for (std::size_t i = 0; i < models.size(); ++i)
      parts.push_back(models[i].part(poses[i]));
    return parts;
  }
};

void
expectNear(const IcpResult& found, const IcpResult& expected)
{
  EXPECT_EQ(found.status, expected.status);
  EXPECT_EQ(found.pairs, expected.pairs);
  EXPECT_NEAR(found.rms, expected.rms, 1e-6);
  const auto error = distanceBetween(found.T_target_source, expected.T_target_source);
  EXPECT_LT(error.translation, 1e-6); // [m] floats a few metres from the origin
  EXPECT_LT(error.rotation, 1e-6);
}
} // namespace

TEST(IcpParts, AreTheirUnion)
{
  Random random(1);
  const IcpModel data = corner(random, 900, 2, 0.01).model();
  for (const std::size_t count : {1u, 2u, 5u, 40u}) {
    const Puzzle puzzle(random, count, 5);
    const IcpModel whole = puzzle.whole.model();
    for (const Metric metric : kAllMetrics) {
      SCOPED_TRACE(testing::Message() << count << " parts, " << toString(metric));
      IcpOptions options;
      options.metric = metric;
      expectNear(icp(puzzle.target(), data.source(), kTruth, options),
                 icp({whole.part()}, data.source(), kTruth, options));
    }
  }
}

TEST(IcpParts, AreExactWithAndWithoutMemory)
{
  Random random(2);
  const IcpModel data = corner(random, 900, 2, 0.01).model();
  for (int trial = 0; trial < 10; ++trial) {
    const Puzzle puzzle(random, 5, 5);
    IcpOptions options;
    const Trace remembers = traceOf(puzzle.target(), data.source(), options, kTruth);
    options.remember_neighbours = false;
    expectSameTrace(remembers,
                    traceOf(puzzle.target(), data.source(), options, kTruth));
    EXPECT_LT(remembers.seen.back().searched, 450u);
  }
}

TEST(IcpParts, AreExactFarFromTheirOwnOrigins)
{
  // The frame of each part stands 2 km off: its floats are 0.1 mm apart.
  Random random(3);
  const IcpModel data = corner(random, 900, 2, 0.01).model();
  for (int trial = 0; trial < 10; ++trial) {
    const Puzzle puzzle(random, 3, 2000);
    IcpOptions options;
    const Trace remembers = traceOf(puzzle.target(), data.source(), options, kTruth);
    options.remember_neighbours = false;
    const Trace forgets = traceOf(puzzle.target(), data.source(), options, kTruth);
    expectSameTrace(remembers, forgets);
  }
}

TEST(IcpParts, MayBeSearchedInDifferentWays)
{
  // The same points: a part with a search of its own beside parts with trees.
  Random random(4);
  const IcpModel data = corner(random, 900, 2, 0.01).model();
  const Puzzle puzzle(random, 3, 5);
  IcpOptions options;
  const Trace expected = traceOf(puzzle.target(), data.source(), options, kTruth);
  for (std::size_t special = 0; special < 3; ++special)
    for (const SearchMethod search : {SearchMethod::kKdTree,
                                      SearchMethod::kCachedTree,
                                      SearchMethod::kOctree,
                                      SearchMethod::kBruteForce,
                                      SearchMethod::kFlann}) {
      SCOPED_TRACE(testing::Message() << toString(search) << " of part " << special);
      IcpTarget mixed = puzzle.target();
      IcpModel::Options of_model;
      of_model.search = search;
      const IcpModel model(
          puzzle.models[special].points(), puzzle.models[special].normals(), of_model);
      mixed[special] = model.part(puzzle.poses[special]);
      expectSameTrace(traceOf(mixed, data.source(), options, kTruth), expected);
    }
}

TEST(IcpParts, OfOneAtAPoseAreTheMovedTarget)
{
  Random random(5);
  const IcpModel data = corner(random, 900, 2, 0.01).model();
  const Surface scene = corner(random, 1800, 2, 0.01);
  const IcpModel model = scene.model();
  const Eigen::Isometry3d pose = poseFromEuler({3, -2, 1}, {0.3, 0.2, -1});
  const IcpModel moved = scene.moved(pose).model();
  for (const Metric metric : kAllMetrics) {
    IcpOptions options;
    options.metric = metric;
    const IcpResult result =
        icp({model.part(pose)}, data.source(), pose * kTruth, options);
    expectNear(result, icp({moved.part()}, data.source(), pose * kTruth, options));
    EXPECT_EQ(result.status, Status::kOk);
  }
}

TEST(IcpParts, MayBeEmpty)
{
  Random random(6);
  const IcpModel data = corner(random, 900, 2, 0.01).model();
  const IcpModel model = corner(random, 1800, 2, 0.01).model();
  const IcpModel none(Points(), {});
  const IcpModel bad({{kNan, 0, 0}, {0, kNan, 0}, {0, 0, kNan}}, {});
  const Trace expected = traceOf({model.part()}, data.source(), {}, kTruth);
  expectSameTrace(traceOf({none.part(), model.part(), bad.part(kTruth), none.part()},
                          data.source(),
                          {},
                          kTruth),
                  expected);
  for (const IcpTarget& empty :
       {IcpTarget(), IcpTarget{none.part()}, IcpTarget{none.part(), bad.part()}}) {
    const IcpResult result = icp(empty, data.source(), kTruth, {});
    EXPECT_EQ(result.status, Status::kTooFewPairs);
    EXPECT_TRUE(sameBits(result.T_target_source, kTruth));
    EXPECT_EQ(result.overlap, 0);
    EXPECT_FALSE(result.information);
    EXPECT_FALSE(result.localizability);
  }
}

TEST(IcpParts, MayOverlapAndRepeat)
{
  // The same scan three times over: each nearest point has two equals.
  Random random(7);
  const IcpModel data = corner(random, 900, 2, 0.01).model();
  const IcpModel model = corner(random, 1800, 2, 0.01).model();
  expectNear(icp({model.part(), model.part(), model.part()}, data.source(), kTruth, {}),
             icp({model.part()}, data.source(), kTruth, {}));
}

TEST(IcpParts, GiveTheSameBitsForEveryNumberOfThreads)
{
  Random random(8);
  const IcpModel data = corner(random, 2400, 2, 0.01).model();
  const Puzzle puzzle(random, 7, 5);
  for (const Metric metric : kAllMetrics)
    for (const RobustKernel robust : {RobustKernel::kNone, RobustKernel::kCauchy}) {
      SCOPED_TRACE(toString(metric));
      IcpOptions options;
      options.metric = metric;
      options.robust = robust;
      options.kept_share = robust == RobustKernel::kNone ? 1 : 0.8;
      options.max_distance_start = 0.5;
      options.num_threads = 1;
      const Trace first = traceOf(puzzle.target(), data.source(), options, kTruth);
      for (const unsigned int threads : {2u, 3u, 8u}) {
        options.num_threads = threads;
        const Trace trace = traceOf(puzzle.target(), data.source(), options, kTruth);
        expectSameTrace(trace, first);
        EXPECT_EQ(trace.seen.back().searched, first.seen.back().searched);
        EXPECT_TRUE(sameBits(*trace.result.information, *first.result.information));
      }
    }
}

TEST(IcpParts, MayAllBeCachedTrees)
{
  for (int trial = 0; trial < 10; ++trial) {
    Random random(20 + trial), again(20 + trial);
    const Puzzle puzzle(random, 5, 5);
    const Puzzle cached(again, 5, 5, SearchMethod::kCachedTree);
    const IcpModel data = corner(random, 900, 2, 0.01).model();
    const Trace trace = traceOf(cached.target(), data.source(), {}, kTruth);
    expectSameTrace(trace, traceOf(puzzle.target(), data.source(), {}, kTruth));
    EXPECT_EQ(trace.seen.back().searched, data.points().size());
    EXPECT_GT(trace.seen.back().from_leaf, data.points().size() / 2);
  }
}

TEST(IcpParts, RememberNoLeavesWithoutTheCellsOfATree)
{
  const Points points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const PointTree tree(points), with_cells(points, 1, PointTree::Cells::kKeep);
  const IcpModel data(points, {});
  IcpTargetPart part;
  part.points = &points;
  part.memory = SearchMemory::kLeaves;
  part.tree = &tree;
  EXPECT_THROW(icp({part}, data.source(), kIdentity, {}), BadArgument);
  part.tree = &with_cells;
  EXPECT_NO_THROW(icp({part}, data.source(), kIdentity, {}));
  part.search = [](const Eigen::Vector3f&, float) { return Neighbour(); };
  EXPECT_THROW(icp({part}, data.source(), kIdentity, {}), BadArgument);
}

TEST(IcpParts, NeedPointsAndASearch)
{
  const Points points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const PointTree tree(points);
  const IcpModel data(points, {});
  IcpTargetPart good, no_points, no_tree;
  good.tree = no_points.tree = &tree;
  good.points = no_tree.points = &points;
  EXPECT_NO_THROW(icp({good}, data.source(), kIdentity, {}));
  EXPECT_THROW(icp({good, no_points}, data.source(), kIdentity, {}), BadArgument);
  EXPECT_THROW(icp({no_tree}, data.source(), kIdentity, {}), BadArgument);
  EXPECT_THROW(icp({good}, {}, kIdentity, {}), BadArgument);
}
