// SPDX-License-Identifier: BSD-3-Clause
// Closest points are exact, however they are found and remembered.
#include "icp_cases.h"

using namespace pcl6d; // NOLINT: the whole API of ICP
using pcl6d::test::corner;
using pcl6d::test::expectSameTrace;
using pcl6d::test::kAllMetrics;
using pcl6d::test::kExactSearches;
using pcl6d::test::kNan;
using pcl6d::test::kTruth;
using pcl6d::test::pairsByForce;
using pcl6d::test::Surface;
using pcl6d::test::Trace;
using pcl6d::test::traceOf;

namespace {

/** Expects the same way to the same pose from every exact search, and without memory.
 * \return the number of iterations */
std::size_t
expectOneTrace(const Surface& target,
               const Surface& source,
               IcpOptions options,
               const Eigen::Isometry3d& guess = Eigen::Isometry3d::Identity())
{
  const IcpModel data = source.model();
  const IcpModel brute = target.model(SearchMethod::kBruteForce);
  options.remember_neighbours = false;
  const Trace expected = traceOf({brute.part()}, data.source(), options, guess);
  for (const SearchMethod search : kExactSearches) {
    SCOPED_TRACE(toString(search));
    const IcpModel model = target.model(search);
    expectSameTrace(traceOf({model.part()}, data.source(), options, guess), expected);
  }
  const IcpModel model = target.model();
  for (const bool remember : {false, true}) {
    SCOPED_TRACE(remember ? "remembers" : "forgets");
    options.remember_neighbours = remember;
    expectSameTrace(traceOf({model.part()}, data.source(), options, guess), expected);
  }
  return expected.seen.size();
}

/** Moves the source by a script instead of by its pairs, and compares the pairs of each
 * iteration with the definition.
 * \return searches of all iterations but the first */
std::size_t
followScript(const Points& target,
             const Points& source,
             const std::vector<Eigen::Isometry3d>& motions,
             double max_distance)
{
  const PointTree tree(target);
  IcpTargetPart part;
  part.tree = &tree;
  part.points = &target;
  IcpOptions options;
  options.max_distance = max_distance;
  options.max_iterations = static_cast<int>(motions.size());
  options.translation_epsilon = options.rotation_epsilon = 0;
  std::size_t step = 0, searched = 0;
  int wrong = 0;
  IcpHooks hooks;
  hooks.reject = [&](const Eigen::Isometry3d& T, std::vector<IcpPair> pairs) {
    const auto expected =
        pairsByForce(target, source, T, static_cast<float>(max_distance));
    EXPECT_EQ(pairs.size(), expected.size()) << "step " << step;
    for (std::size_t i = 0; i < std::min(pairs.size(), expected.size()); ++i)
      if (pairs[i].source != expected[i].source ||
          pairs[i].target != expected[i].target)
        if (++wrong < 4)
          ADD_FAILURE() << "step " << step << ": source " << pairs[i].source << " at "
                        << transformed(source, T)[pairs[i].source].transpose()
                        << " has " << pairs[i].target << ", nearest is "
                        << expected[i].target << " [" << expected[i].source << "]";
    return pairs;
  };
  hooks.minimise = [&](const Eigen::Isometry3d&, const std::vector<IcpPair>&) {
    return RigidEstimate{Status::kOk, motions[step]};
  };
  hooks.observer = [&](const IcpIteration& i) {
    searched += step > 0 ? i.searched : 0;
    ++step;
    return true;
  };
  icp({part}, {&source}, Eigen::Isometry3d::Identity(), options, hooks);
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(step, motions.size()) << "the script was cut short";
  return searched;
}

std::vector<Eigen::Isometry3d>
randomSteps(Random& random, std::size_t count, double length)
{
  std::vector<Eigen::Isometry3d> steps;
  for (std::size_t i = 0; i < count; ++i)
    steps.push_back(test::randomPose(random, length, 0.1 * length));
  return steps;
}

} // namespace

TEST(IcpNeighbours, AreThoseOfEverySearchOnTheWay)
{
  Random random(1);
  const Surface target = corner(random, 1500, 2, 0.01);
  const Surface source = corner(random, 900, 2, 0.01);
  for (const Metric metric : kAllMetrics) {
    SCOPED_TRACE(toString(metric));
    IcpOptions options;
    options.metric = metric;
    EXPECT_GT(expectOneTrace(target, source, options, kTruth), 3u);
  }
}

TEST(IcpNeighbours, StaySoWhileTheLimitShrinks)
{
  Random random(2);
  const Surface target = corner(random, 1500, 2, 0.01);
  const Surface source = corner(random, 900, 2, 0.01);
  IcpOptions options;
  options.max_distance_start = 1;
  options.max_distance = 0.04; // below the spacing of the points
  EXPECT_GT(expectOneTrace(target, source, options, kTruth), 30u);
  options.kept_share = 0.7;
  expectOneTrace(target, source, options, kTruth);
  options.robust = RobustKernel::kCauchy;
  expectOneTrace(target, source, options, kTruth);
}

TEST(IcpNeighbours, StaySoWithDuplicatesAndNan)
{
  Random random(3);
  Surface target = corner(random, 600, 2, 0.01);
  target.add(target);
  Surface source = corner(random, 300, 2, 0.01);
  source.add(source);
  for (std::size_t i = 0; i < target.points.size(); i += 7)
    target.points[i].x() = kNan;
  for (std::size_t i = 0; i < source.points.size(); i += 5)
    source.points[i].z() = i % 2 ? kNan : test::kInfinity;
  expectOneTrace(target, source, {}, kTruth);
}

TEST(IcpNeighbours, StaySoWithTiesOnGrids)
{
  // Points of a grid, seen from the middles of its cells and edges.
  Surface target, source;
  for (int x = -3; x <= 3; ++x)
    for (int y = -3; y <= 3; ++y)
      for (int z = -3; z <= 3; ++z) {
        target.add(Eigen::Vector3d(x, y, z), Eigen::Vector3d::UnitX());
        source.add(Eigen::Vector3d(x, y, z) * 0.5, Eigen::Vector3d::UnitX());
      }
  for (const double shift : {0.0, 0.25, 0.125})
    for (const double limit : {0.3, 0.5, 0.9, 3.0})
      for (const double share : {1.0, 0.6}) {
        SCOPED_TRACE(testing::Message()
                     << shift << " within " << limit << " kept " << share);
        IcpOptions options;
        options.max_distance = limit;
        options.kept_share = share;
        options.max_iterations = 20;
        options.translation_epsilon = options.rotation_epsilon = 0;
        expectOneTrace(
            target, source, options, poseFromEuler({shift, shift, 0.01}, {0, 0, 0.01}));
      }
}

TEST(IcpNeighbours, AreRememberedNearTheEnd)
{
  Random random(4);
  const Surface target = corner(random, 9000, 4, 0.01);
  const Surface source = corner(random, 3000, 4, 0.01);
  const IcpModel model = target.model(), data = source.model();
  IcpOptions options;
  const Trace trace = traceOf({model.part()}, data.source(), options, kTruth);
  EXPECT_EQ(trace.seen.front().searched, source.points.size());
  EXPECT_LT(trace.seen.back().searched, source.points.size() / 5);
  options.remember_neighbours = false;
  const Trace forgets = traceOf({model.part()}, data.source(), options, kTruth);
  EXPECT_EQ(forgets.seen.back().searched, source.points.size());
}

TEST(IcpNeighbours, AreSearchedFromTheirLeavesByTheCachedTree)
{
  Random random(8);
  Surface target = corner(random, 9000, 4, 0.01);
  Surface source = corner(random, 3000, 4, 0.01);
  source.points[0].x() = kNan;             // never has a leaf,
  source.points[1] = {100.0f, 0.0f, 0.0f}; // nor has what finds nothing
  const std::size_t all = source.points.size();
  const IcpModel data = source.model();
  IcpOptions options;
  for (const bool remember : {true, false}) { // another memory
    options.remember_neighbours = remember;
    const IcpModel model = target.model(SearchMethod::kCachedTree);
    const Trace trace = traceOf({model.part()}, data.source(), options, kTruth);
    ASSERT_GT(trace.seen.size(), 3u);
    EXPECT_EQ(trace.seen.front().from_leaf, 0u);
    for (std::size_t i = 0; i < trace.seen.size(); ++i) {
      EXPECT_EQ(trace.seen[i].searched, all) << "each in each iteration";
      if (i > 0) {
        EXPECT_GT(trace.seen[i].from_leaf, all * 9 / 10);
        EXPECT_LE(trace.seen[i].from_leaf, all - 2);
      }
    }
  }
  for (const SearchMethod search : {SearchMethod::kKdTree, SearchMethod::kOctree}) {
    const IcpModel model = target.model(search);
    const Trace trace = traceOf({model.part()}, data.source(), {}, kTruth);
    EXPECT_EQ(trace.seen.back().searched, all) << "remembers nothing";
    EXPECT_EQ(trace.seen.back().from_leaf, 0u);
  }
}

TEST(IcpNeighbours, AreNearestOnAScriptedWalk)
{
  Random random(5);
  const Points target = test::randomCube(random, 4000, 2);
  const Points source = test::randomCube(random, 500, 2);
  for (const double length : {1e-4, 1e-3, 1e-2, 0.05}) {
    SCOPED_TRACE(length);
    const auto steps = randomSteps(random, 30, length);
    const std::size_t searched = followScript(target, source, steps, 0.5);
    if (length < 1e-3) {
      EXPECT_LT(searched, 500u * 29 / 2) << "nothing was remembered";
    }
  }
}

TEST(IcpNeighbours, AreNearestWithStandstillAndJumps)
{
  Random random(6);
  const Points target = test::randomCube(random, 4000, 2);
  const Points source = test::randomCube(random, 500, 2);
  std::vector<Eigen::Isometry3d> steps;
  for (int i = 0; i < 30; ++i) {
    const double length = i % 3 == 0 ? 1e-12 : i % 7 == 0 ? 0.3 : 1e-3;
    steps.push_back(randomSteps(random, 1, length).front());
  }
  followScript(target, source, steps, 0.1);
}

TEST(IcpNeighbours, AreNearestAboutTheOriginToo)
{
  // Points near the origin, whose coordinates are small against the distances: all of a
  // sphere's points are nearly as near as the nearest.
  Random random(7);
  Points target;
  for (int i = 0; i < 20000; ++i)
    target.push_back(
        (10 * Eigen::Vector3d(random.normal(), random.normal(), random.normal())
                  .normalized())
            .cast<float>());
  const Points source = test::randomCube(random, 200, 0.002);
  followScript(target, source, randomSteps(random, 40, 2e-5), 11);
}

TEST(IcpNeighbours, AreTheFirstOfTiesAboutTheOrigin)
{
  // Two points as near as one another once the source stands in the middle.
  const Points target{{-0.1f, 0, 0},
                      {0.1f, 0, 0},
                      {-0.1f, 5, 0},
                      {0.1f, 5, 0},
                      {0, 9, 0.1f},
                      {0, 9, -0.1f}};
  for (const float start : {0.01f, 0.003f, 0.007f, 0.013f, 0.0171f}) {
    SCOPED_TRACE(start);
    // At twice the start, at the start, in the middle: the first step makes the second
    // search look far enough.
    const double s = start;
    const Points source{
        {start + start, 0, 0}, {start + start, 5, 0}, {start + start, 9, 0.05f}};
    const Eigen::Isometry3d step = poseFromEuler({-s, 0, 0}, {});
    followScript(target, source, {step, step, step, step.inverse()}, 0.5);
  }
}
