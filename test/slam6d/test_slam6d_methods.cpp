// SPDX-License-Identifier: BSD-3-Clause
// Every metric, robust kernel and search of Slam6D, and any number of threads.
#include "registered_run.h"
#include "support/bits.h"
#include "support/drift.h"

#include <pcl6d/registration/minimisers.h>
#include <pcl6d/slam6d/slam6d.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>

using pcl6d::Metric;
using pcl6d::RobustKernel;
using pcl6d::SearchMethod;
using pcl6d::Slam6D;
using pcl6d::Slam6DOptions;
using pcl6d::Slam6DResult;
using pcl6d::test::DriftingRun;
using pcl6d::test::registered;

namespace {
constexpr double kVoxel = 0.3; // [m] coarse, for speed

/** \return the first scan that differs in a bit; "" if none does */
std::string
differenceOf(const Slam6DResult& a, const Slam6DResult& b)
{
  if (a.scans.size() != b.scans.size())
    return "number of scans";
  for (std::size_t i = 0; i < a.scans.size(); ++i)
    if (!pcl6d::test::sameBits(a.scans[i].T_world_scan, b.scans[i].T_world_scan) ||
        a.scans[i].rms != b.scans[i].rms || a.scans[i].pairs != b.scans[i].pairs ||
        a.scans[i].iterations != b.scans[i].iterations ||
        a.scans[i].covariance != b.scans[i].covariance)
      return "scan " + std::to_string(i);
  return "";
}

double
largestError(const Slam6DResult& result, const std::vector<Eigen::Isometry3d>& truth)
{
  double largest = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    largest = std::max(
        largest,
        pcl6d::distanceBetween(truth[i], result.scans[i].T_world_scan).translation);
  return largest;
}

std::string
wordOf(std::string word)
{
  std::replace(word.begin(), word.end(), '-', '_');
  return word;
}
} // namespace

class EveryMethod
: public testing::TestWithParam<std::tuple<std::string, std::string>> {
protected:
  EveryMethod()
  {
    options_.metric = pcl6d::metricFromName(std::get<0>(GetParam()));
    options_.robust = pcl6d::robustKernelFromName(std::get<1>(GetParam()));
    options_.voxel = kVoxel;
  }
  const DriftingRun run_ = pcl6d::test::makeDriftingRun(4);
  Slam6DOptions options_;
};

TEST_P(EveryMethod, FollowsThePathWithTheSameBitsForEveryExactSearch)
{
  options_.search = SearchMethod::kRemembered;
  const Slam6DResult remembered = registered(run_, options_);
  EXPECT_TRUE(remembered.trusted());
  // What is left over is a share of the voxel, as in test_slam6d; the odometry is 0.2 m
  // off.
  EXPECT_LT(largestError(remembered, run_.truth), 0.25 * kVoxel);
  for (const auto search : {SearchMethod::kKdTree,
                            SearchMethod::kCachedTree,
                            SearchMethod::kOctree,
                            SearchMethod::kBruteForce,
                            SearchMethod::kFlann}) { // no two are equally near
    options_.search = search;
    EXPECT_EQ(differenceOf(registered(run_, options_), remembered), "")
        << toString(search);
  }
}

TEST_P(EveryMethod, IsCloseWithApproximateSearch)
{
  options_.relaxation.reset(); // taken or not, it is another result
  const Slam6DResult exact = registered(run_, options_);
  options_.search = SearchMethod::kApproximate;
  const Slam6DResult approximate = registered(run_, options_);
  EXPECT_TRUE(approximate.trusted());
  std::vector<Eigen::Isometry3d> expected;
  for (const auto& scan : exact.scans)
    expected.push_back(scan.T_world_scan);
  EXPECT_LT(largestError(approximate, expected), 0.1 * kVoxel);
}

TEST_P(EveryMethod, GivesTheSameBitsForEveryNumberOfThreads)
{
  options_.num_threads = 1;
  const Slam6DResult one = registered(run_, options_);
  for (const unsigned int threads : {2u, 3u, 8u}) {
    options_.num_threads = threads;
    EXPECT_EQ(differenceOf(registered(run_, options_), one), "") << threads;
  }
}

INSTANTIATE_TEST_SUITE_P(
    MetricAndKernel,
    EveryMethod,
    testing::Combine(testing::ValuesIn(pcl6d::metricNames()),
                     testing::ValuesIn(pcl6d::robustKernelNames())),
    [](const auto& info) {
      return std::get<0>(info.param) + "_" + wordOf(std::get<1>(info.param));
    });

TEST(Slam6DMethods, FollowThePathWithEveryMinimiser)
{
  const DriftingRun run = pcl6d::test::makeDriftingRun(3);
  Slam6DOptions options;
  options.voxel = kVoxel;
  for (const auto& name : pcl6d::planeMinimiserNames()) {
    options.plane_minimiser = pcl6d::planeMinimiserFromName(name);
    for (const auto metric : {Metric::kPlane, Metric::kGicp}) {
      options.metric = metric;
      const Slam6DResult result = registered(run, options);
      EXPECT_TRUE(result.trusted()) << name << ' ' << toString(metric);
      EXPECT_LT(largestError(result, run.truth), 0.25 * kVoxel) << name;
    }
  }
  options.metric = Metric::kPoint;
  for (const auto& name : pcl6d::minimiserNames()) {
    options.minimiser = pcl6d::minimiserFromName(name);
    const Slam6DResult result = registered(run, options);
    EXPECT_TRUE(result.trusted()) << name;
    EXPECT_LT(largestError(result, run.truth), 0.25 * kVoxel) << name;
  }
}

TEST(Slam6DMethods, AMinimiserOfAnotherMetricChangesNothing)
{
  const DriftingRun run = pcl6d::test::makeDriftingRun(3);
  Slam6DOptions options;
  options.voxel = kVoxel;
  const Slam6DResult gicp = registered(run, options);
  options.minimiser = pcl6d::minimiserFromName("svd");
  EXPECT_EQ(differenceOf(registered(run, options), gicp), "");
  Slam6DOptions point;
  point.voxel = kVoxel;
  point.metric = Metric::kPoint;
  const Slam6DResult of_points = registered(run, point);
  EXPECT_NE(differenceOf(of_points, gicp), "") << "the metric does count";
  point.plane_minimiser = pcl6d::planeMinimiserFromName("linear");
  EXPECT_EQ(differenceOf(registered(run, point), of_points), "");
}
