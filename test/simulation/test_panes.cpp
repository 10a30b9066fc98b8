// SPDX-License-Identifier: BSD-3-Clause
// Glass: a stated share of the rays goes through a pane.
#include <pcl6d/common/error.h>
#include <pcl6d/scanner/scanner_presets.h>
#include <pcl6d/simulation/cast_scan.h>
#include <pcl6d/simulation/scene_builder.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {
using pcl6d::RangeOptions;
using pcl6d::RangeScan;
using pcl6d::RayCaster;
using pcl6d::TriangleScene;

constexpr double kNear = 2; // [m] from the scanner to the first pane
constexpr double kFar = 5;  // [m] and to the wall
constexpr double kLeastSamples = 20000;

// A wall ahead of the scanner, and panes ahead of the wall.
TriangleScene
wallBehindPanes(int panes, double transmittance)
{
  pcl6d::Surface glass{"glass", 0.15};
  glass.transmittance = transmittance;
  TriangleScene scene;
  pcl6d::addBox(scene, {kFar, -50, -50}, {kFar + 1, 50, 50}, {"wall", 0.5});
  for (int i = 0; i < panes; ++i) {
    const double x = kNear + 0.5 * i;
    pcl6d::addBox(scene, {x, -50, -50}, {x + 0.01, 50, 50}, glass);
  }
  return scene;
}

RangeOptions
exactRanges()
{
  RangeOptions options;
  options.noise = 0;
  return options;
}

RangeScan
scanOf(const TriangleScene& scene,
       const RangeOptions& options = exactRanges(),
       const std::string& scanner = "pitching")
{
  return castScan(RayCaster(scene),
                  *pcl6d::scannerByName(scanner).scanner,
                  Eigen::Isometry3d::Identity(),
                  options);
}

// Of the samples that see the wall when no pane is in their way, those that lie on a
// surface of that name.
double
shareOn(const RangeScan& scan, const TriangleScene& scene, const std::string& name)
{
  const RangeScan clear = scanOf(wallBehindPanes(0, 0));
  double all = 0;
  double there = 0;
  for (std::size_t i = 0; i < scan.samples.size(); ++i) {
    if (!std::isfinite(clear.samples[i].range))
      continue;
    ++all;
    const std::uint32_t surface = scene.triangles[scan.samples[i].triangle].surface;
    there +=
        std::isfinite(scan.samples[i].range) && scene.surfaces[surface].name == name;
  }
  EXPECT_GT(all, kLeastSamples);
  return there / all;
}

void
expectSameRanges(const RangeScan& a, const RangeScan& b, double tolerance)
{
  ASSERT_EQ(a.samples.size(), b.samples.size());
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    ASSERT_EQ(std::isfinite(a.samples[i].range), std::isfinite(b.samples[i].range));
    if (std::isfinite(a.samples[i].range)) {
      ASSERT_NEAR(a.samples[i].range, b.samples[i].range, tolerance) << "sample " << i;
    }
  }
}

// Five standard deviations of a share that is counted over the samples.
double
shareTolerance(double share)
{
  return 5 * std::sqrt(share * (1 - share) / kLeastSamples);
}
} // namespace

TEST(Panes, LetTheStatedShareOfRaysThrough)
{
  for (const double share : {0.2, 0.5, 0.8}) {
    const TriangleScene one = wallBehindPanes(1, share);
    EXPECT_NEAR(shareOn(scanOf(one), one, "wall"), share, shareTolerance(share));
    const TriangleScene two = wallBehindPanes(2, share); // each decides for itself
    EXPECT_NEAR(shareOn(scanOf(two), two, "wall"),
                share * share,
                shareTolerance(share * share));
  }
}

TEST(Panes, AreWallsOrAirAtTheEndsOfTheirRange)
{
  const TriangleScene wall = wallBehindPanes(1, 0);
  EXPECT_EQ(shareOn(scanOf(wall), wall, "glass"), 1);
  const TriangleScene air = wallBehindPanes(2, 1);
  EXPECT_EQ(shareOn(scanOf(air), air, "glass"), 0);
  // A range is a sum of ways from pane to pane: a few ulp of 30 m.
  expectSameRanges(scanOf(air), scanOf(wallBehindPanes(0, 0)), 1e-13);
}

TEST(Panes, ReturnRaysFromWhereTheyAre)
{
  const TriangleScene scene = wallBehindPanes(1, 0.5);
  const RangeScan pane = scanOf(wallBehindPanes(1, 0));
  const RangeScan wall = scanOf(wallBehindPanes(0, 0));
  const RangeScan scan = scanOf(scene);
  for (std::size_t i = 0; i < scan.samples.size(); ++i) {
    const auto& sample = scan.samples[i];
    if (!std::isfinite(sample.range))
      continue;
    const bool is_through =
        scene.surfaces[scene.triangles[sample.triangle].surface].name == "wall";
    ASSERT_NEAR(sample.range, (is_through ? wall : pane).samples[i].range, 1e-13);
  }
}

TEST(Panes, DependOnTheSeedAndNotOnThreads)
{
  const TriangleScene scene = wallBehindPanes(1, 0.5);
  RangeOptions options;
  options.num_threads = 1;
  const RangeScan first = scanOf(scene, options);
  const auto differing = [&first](const RangeScan& other) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < first.samples.size(); ++i)
      count += other.samples[i].triangle != first.samples[i].triangle;
    return count;
  };
  for (const unsigned threads : {2u, 3u, 8u}) {
    options.num_threads = threads;
    const RangeScan again = scanOf(scene, options);
    EXPECT_EQ(differing(again), 0u);
    expectSameRanges(first, again, 0);
  }
  options.seed = 2;
  EXPECT_GT(differing(scanOf(scene, options)), first.samples.size() / 4);
}

TEST(Panes, LeaveTheNoiseOfOtherRaysAsItIs)
{
  const RangeOptions noisy;
  const TriangleScene scene = wallBehindPanes(1, 0.5);
  const RangeScan clear = scanOf(wallBehindPanes(0, 0), noisy);
  const RangeScan scan = scanOf(scene, noisy);
  for (std::size_t i = 0; i < scan.samples.size(); ++i)
    if (scene.surfaces[scene.triangles[scan.samples[i].triangle].surface].name ==
            "wall" &&
        std::isfinite(scan.samples[i].range)) {
      ASSERT_NEAR(scan.samples[i].range, clear.samples[i].range, 1e-13);
    }
}

TEST(Panes, LetTheLightOfAProjectorThrough)
{
  expectSameRanges(scanOf(wallBehindPanes(2, 1), exactRanges(), "projection"),
                   scanOf(wallBehindPanes(0, 0), exactRanges(), "projection"),
                   1e-13);
}

TEST(Panes, HaveATransmittanceThatIsAShare)
{
  for (const double wrong : {-0.1, 1.1, std::nan("")})
    EXPECT_THROW(wallBehindPanes(1, wrong).validate(), pcl6d::BadArgument);
}
