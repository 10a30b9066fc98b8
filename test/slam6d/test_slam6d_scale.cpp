// SPDX-License-Identifier: BSD-3-Clause
// Nothing of a run knows metres: a scene at 1:100 and one a hundred times as large get the same
// decisions and, scaled back, the same poses.
#include "ring_run.h"
#include "scaled_run.h"

using pcl6d::Slam6DOptions;
using pcl6d::Slam6DResult;
using pcl6d::test::DriftingRun;
using pcl6d::test::optionsAt;
using pcl6d::test::pairwise;
using pcl6d::test::registered;
using pcl6d::test::scaled;

namespace {
class Scale : public testing::TestWithParam<double> {
protected:
  void
  compare(const DriftingRun& run, const Slam6DOptions& options) const
  {
    const Slam6DResult here = registered(run, optionsAt(options, 1));
    const Slam6DResult there =
        registered(scaled(run, GetParam()), optionsAt(options, GetParam()));
    EXPECT_NEAR(
        here.parameters.voxel.value, there.parameters.voxel.value / GetParam(), 1e-9);
    pcl6d::test::expectSameDecisions(here, there, GetParam());
  }
};
} // namespace

TEST_P(Scale, ChangesNothingOfARing)
{
  compare(pcl6d::test::makeRingRun(9), pairwise());
}

TEST_P(Scale, ChangesNothingOfALoopThatIsClosed)
{
  Slam6DOptions options = pairwise();
  options.max_range = 5;
  options.max_distance = 0.25;
  compare(pcl6d::test::makeRunAroundBlock(37), options);
}

TEST_P(Scale, ChangesNothingOfMatchingByPoints)
{
  Slam6DOptions options = pairwise();
  options.metric = pcl6d::Metric::kPoint;
  options.loop_closing = pcl6d::LoopClosing::kUniform;
  compare(pcl6d::test::makeRingRun(9), options);
}

INSTANTIATE_TEST_SUITE_P(Units, Scale, testing::Values(0.01, 100.0));
