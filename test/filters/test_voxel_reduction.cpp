// SPDX-License-Identifier: BSD-3-Clause
#include "support/points.h"
#include "support/poses.h"

#include <pcl6d/filters/voxel_reduction.h>

#include <array>
#include <cmath>
#include <map>
#include <set>

using pcl6d::Points;
using pcl6d::Random;
using pcl6d::reducePoints;
using pcl6d::ReductionMethod;
using pcl6d::ReductionOptions;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kInfinity;
using pcl6d::test::kNan;
using pcl6d::test::sorted;

namespace {
constexpr double kVoxel = 0.5; // [m] a power of two: cells are exact in float
using Cell = std::array<int, 3>;

Cell
cellOf(const Eigen::Vector3f& p, double voxel = kVoxel)
{
  Cell cell;
  for (int axis = 0; axis < 3; ++axis)
    cell[axis] = static_cast<int>(std::floor(p[axis] / voxel));
  return cell;
}

/** The oracle: the points of each occupied cell, in their order. */
std::map<Cell, Points>
groupsOf(const Points& points)
{
  std::map<Cell, Points> groups;
  for (const auto& p : points)
    if (p.allFinite())
      groups[cellOf(p)].push_back(p);
  return groups;
}

ReductionOptions
options(ReductionMethod method, int points_per_voxel = 1, std::uint64_t seed = 0)
{
  ReductionOptions o;
  o.voxel = kVoxel;
  o.method = method;
  o.points_per_voxel = points_per_voxel;
  o.seed = seed;
  return o;
}

/** About 4 points per voxel, on both sides of the origin. */
Points
samplePoints(std::uint64_t seed = 1)
{
  Random random(seed);
  return pcl6d::test::randomCube(random, 2000, 4);
}

Points
shuffled(Points points)
{
  Random random(77);
  for (std::size_t i = points.size(); i > 1; --i)
    std::swap(points[i - 1], points[static_cast<std::size_t>(random.uniform() * i)]);
  return points;
}
} // namespace

TEST(ReducePoints, LeavesOnePointInEachOccupiedVoxel)
{
  const Points points = samplePoints();
  const auto groups = groupsOf(points);
  for (const auto method :
       {ReductionMethod::kCentre, ReductionMethod::kMean, ReductionMethod::kRandom}) {
    const Points reduced = reducePoints(points, options(method));
    std::set<Cell> cells;
    for (const auto& p : reduced)
      cells.insert(cellOf(p));
    EXPECT_EQ(reduced.size(), groups.size());
    EXPECT_EQ(cells.size(), groups.size());
    for (const auto& cell : cells)
      EXPECT_EQ(groups.count(cell), 1u);
  }
}

TEST(ReducePoints, PutsCentresOnTheGridWithinHalfADiagonal)
{
  const Points points = samplePoints();
  std::set<Cell> centres;
  for (const auto& centre : reducePoints(points, options(ReductionMethod::kCentre))) {
    for (int axis = 0; axis < 3; ++axis) // exact: voxel is a power of two
      EXPECT_EQ(centre[axis], (cellOf(centre)[axis] + 0.5) * kVoxel);
    centres.insert(cellOf(centre));
  }
  for (const auto& p : points) {
    ASSERT_EQ(centres.count(cellOf(p)), 1u);
    Eigen::Vector3d centre;
    for (int axis = 0; axis < 3; ++axis)
      centre[axis] = (cellOf(p)[axis] + 0.5) * kVoxel;
    EXPECT_LE((p.cast<double>() - centre).norm(), kVoxel * std::sqrt(3) / 2);
  }
}

TEST(ReducePoints, AveragesByHand)
{
  const Points points{{0.125f, 0.25f, 0.375f}, {-0.25f, 0, 0}, {0.375f, 0.25f, 0}};
  const Points reduced = sorted(reducePoints(points, options(ReductionMethod::kMean)));
  ASSERT_EQ(reduced.size(), 2u);
  EXPECT_EQ(reduced[0], Eigen::Vector3f(-0.25f, 0, 0));
  EXPECT_EQ(reduced[1], Eigen::Vector3f(0.25f, 0.25f, 0.1875f));
}

TEST(ReducePoints, AveragesEachVoxel)
{
  const Points points = samplePoints();
  const auto groups = groupsOf(points);
  for (const auto& mean : reducePoints(points, options(ReductionMethod::kMean))) {
    const Points& group = groups.at(cellOf(mean)); // throws if outside its voxel
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& p : group)
      sum += p.cast<double>();
    const Eigen::Vector3d expected = sum / static_cast<double>(group.size());
    // One rounding to float of a coordinate below 2 m.
    EXPECT_LT((mean.cast<double>() - expected).norm(), 4e-7);
  }
}

TEST(ReducePoints, AveragesToTheBitsOfTheGroups)
{
  Random random(8);
  Points points;
  for (int i = 0; i < 5003; ++i) // no multiple of what is looked at at once
    points.emplace_back(static_cast<float>(random.uniform(-9, 9)),
                        static_cast<float>(random.uniform(-2, 2)),
                        static_cast<float>(random.uniform(-0.1, 5)));
  points[7].setConstant(kNan);
  points[9] = points[11] = {-0.0F, -0.0F, 0.0F}; // zeros of sums are positive
  points[5000] = {-0.0F, 8.0F, -0.0F};
  for (const double voxel : {0.02, 0.3, 2.0, 1e-5, 1e-9 + 3e-5}) {
    const pcl6d::VoxelGroups groups(points, voxel);
    ReductionOptions options;
    options.voxel = voxel;
    const Points means = reducePoints(points, options);
    ASSERT_EQ(means.size(), groups.size());
    for (std::size_t g = 0; g < means.size(); ++g) {
      const Eigen::Vector3f mean = meanOf(points, groups.indices(g));
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_EQ(means[g][axis], mean[axis]);
        ASSERT_EQ(std::signbit(means[g][axis]), std::signbit(mean[axis]));
      }
    }
  }
}

TEST(ReducePoints, KeepsMeasuredPointsAtRandom)
{
  const Points points = samplePoints();
  const auto groups = groupsOf(points);
  for (const int count : {1, 3, 1000}) {
    std::map<Cell, Points> kept =
        groupsOf(reducePoints(points, options(ReductionMethod::kRandom, count)));
    ASSERT_EQ(kept.size(), groups.size());
    for (const auto& [cell, group] : groups) {
      EXPECT_EQ(kept[cell].size(), std::min<std::size_t>(count, group.size()));
      // In the order of the input, none twice: a subsequence.
      auto at = group.begin();
      for (const auto& p : kept[cell]) {
        at = std::find(at, group.end(), p);
        ASSERT_NE(at, group.end());
        ++at;
      }
    }
  }
}

TEST(ReducePoints, ChoosesByTheSeedAlone)
{
  const Points points = samplePoints();
  const auto chosen = [&](std::uint64_t seed) {
    return reducePoints(points, options(ReductionMethod::kRandom, 1, seed));
  };
  EXPECT_EQ(chosen(5), chosen(5));
  EXPECT_NE(chosen(5), chosen(6));
}

TEST(ReducePoints, ChoosesEveryPointEquallyOften)
{
  const Points points{{0.1f, 0, 0}, {0.2f, 0, 0}, {0.3f, 0, 0}, {0.4f, 0, 0}};
  constexpr int kSeeds = 4000;
  std::map<float, int> times;
  for (int seed = 0; seed < kSeeds; ++seed)
    for (const auto& p :
         reducePoints(points, options(ReductionMethod::kRandom, 2, seed)))
      ++times[p.x()];
  // Each point is kept with probability 1/2; five standard deviations.
  const double tolerance = 5 * std::sqrt(kSeeds * 0.25);
  for (const auto& p : points)
    EXPECT_NEAR(times[p.x()], kSeeds / 2, tolerance);
}

TEST(ReducePoints, ChoosesInAVoxelWhateverElseThereIs)
{
  // The choice is keyed by the voxel: other voxels must not change it.
  const Points points = samplePoints();
  const Cell cell = cellOf(points.front());
  const auto keptIn = [&](const Points& some) {
    return groupsOf(reducePoints(some, options(ReductionMethod::kRandom, 2))).at(cell);
  };
  EXPECT_EQ(keptIn(points), keptIn(groupsOf(points).at(cell)));
}

TEST(ReducePoints, GivesTheSameCentresAndMeansForEveryOrderOfThePoints)
{
  const Points points = samplePoints();
  const Points other = shuffled(points);
  const auto centre = options(ReductionMethod::kCentre);
  EXPECT_EQ(reducePoints(points, centre), reducePoints(other, centre));
  const Points a = reducePoints(points, options(ReductionMethod::kMean));
  const Points b = reducePoints(other, options(ReductionMethod::kMean));
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) // double sums: at most the last float bit
    EXPECT_LT((a[i] - b[i]).norm(), 4e-7f);
}

TEST(ReducePoints, LeavesOutPointsThatAreNotFinite)
{
  Points points = samplePoints();
  const auto o = options(ReductionMethod::kMean);
  const Points expected = reducePoints(points, o);
  points.insert(points.begin(), {kNan, 0, 0});
  points.insert(points.begin() + 7, {0, kInfinity, 0});
  points.push_back({0, 0, -kInfinity});
  EXPECT_EQ(reducePoints(points, o), expected);
  EXPECT_TRUE(reducePoints({{kNan, kNan, kNan}}, o).empty());
  EXPECT_TRUE(reducePoints({}, o).empty());
}

TEST(ReducePoints, PutsAPointOnABorderIntoTheUpperVoxel)
{
  const Points points{{0, 0, 0}, {-1e-6f, 0, 0}, {0.5f, 0, 0}, {0.49999f, 0, 0}};
  EXPECT_EQ(reducePoints(points, options(ReductionMethod::kCentre)).size(), 3u);
}

TEST(ReducePoints, CoversHugeExtentsWithoutWrappingAround)
{
  // 10 km at 1 cm: 10^18 voxels, where the 32-bit index of pcl::VoxelGrid overflows.
  ReductionOptions o = options(ReductionMethod::kCentre);
  o.voxel = 0.01;
  Points far;
  for (const float x : {-5000.0f, 0.0f, 5000.0f})
    for (const float y : {-5000.0f, 0.0f, 5000.0f})
      for (const float z : {-5000.0f, 0.0f, 5000.0f})
        far.push_back({x, y, z});
  EXPECT_EQ(reducePoints(far, o).size(), 27u);
}

TEST(ReducePoints, RefusesWhatDoesNotFitIntoTheGrid)
{
  const auto o = options(ReductionMethod::kMean);
  const float edge = static_cast<float>(kVoxel * (1 << 20)); // 21 bits per axis
  EXPECT_EQ(reducePoints({{-edge, 0, 0}}, o).size(), 1u);
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Vector3f p = Eigen::Vector3f::Zero();
    p[axis] = edge;
    EXPECT_THROW(reducePoints({p}, o), pcl6d::BadArgument);
    p[axis] = -1.001f * edge;
    EXPECT_THROW(reducePoints({p}, o), pcl6d::BadArgument);
  }
}

TEST(ReductionOptions, NameTheValueThatBreaksItsRule)
{
  ReductionOptions o;
  EXPECT_NO_THROW(o.validate());
  for (const double voxel : {0.0, -1.0, double{kNan}, double{kInfinity}}) {
    o.voxel = voxel;
    EXPECT_NE(badArgumentOf([&] { reducePoints({}, o); }).find("voxel = "),
              std::string::npos);
  }
  EXPECT_EQ(badArgumentOf([&] { o.validate(); }),
            "voxel = inf, but must be finite and > 0");
  o = ReductionOptions();
  o.points_per_voxel = 0;
  EXPECT_EQ(badArgumentOf([&] { o.validate(); }),
            "points_per_voxel = 0, but must be >= 1");
}

TEST(ReductionMethodNames, AreThoseOfTheMethods)
{
  for (const auto& name : pcl6d::reductionMethodNames())
    EXPECT_EQ(toString(pcl6d::reductionMethodFromName(name)), name);
  EXPECT_EQ(pcl6d::reductionMethodNames().front(), "mean");
  EXPECT_THROW(pcl6d::reductionMethodFromName("median"), pcl6d::BadArgument);
}
