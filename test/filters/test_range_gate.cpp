// SPDX-License-Identifier: BSD-3-Clause
#include "support/clouds.h"
#include "support/points.h"

#include <pcl6d/filters/pcl/range_gate.h>
#include <pcl6d/filters/range_statistics.h>

using pcl6d::RangeGate;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kInfinity;
using pcl6d::test::kNan;
using pcl6d::test::toCloud;

namespace {
using GatePoint = pcl::PointXYZ;
/** Ranges 1, 5, 5 + 1 ulp, 10, none, none, 0: places 0 to 6. */
const pcl6d::Points kPoints{{1, 0, 0},
                            {3, 0, -4},
                            {0, 5.0000005f, 0},
                            {0, -6, 8},
                            {kNan, 0, 0},
                            {0, 0, kInfinity},
                            {0, 0, 0}};

pcl::Indices
kept(RangeGate<GatePoint>& gate)
{
  gate.setInputCloud(toCloud<GatePoint>(kPoints));
  pcl::Indices indices;
  gate.filter(indices);
  return indices;
}
} // namespace

TEST(RangeGate, KeepsPointsAtBothLimits)
{
  RangeGate<GatePoint> gate;
  gate.setLimits(1, 5);
  EXPECT_EQ(kept(gate), (pcl::Indices{0, 1}));
  gate.setLimits(5, 10);
  EXPECT_EQ(kept(gate), (pcl::Indices{1, 2, 3}));
  gate.setLimits(5, 5);
  EXPECT_EQ(kept(gate), (pcl::Indices{1}));
}

TEST(RangeGate, KeepsAllFinitePointsUnlessToldOtherwise)
{
  RangeGate<GatePoint> gate;
  EXPECT_EQ(kept(gate), (pcl::Indices{0, 1, 2, 3, 6}));
}

TEST(RangeGate, KeepsTheOthersWhenNegative)
{
  RangeGate<GatePoint> gate;
  gate.setLimits(1, 5);
  gate.setNegative(true);
  // Points that are not finite never pass, as in pcl::PassThrough.
  EXPECT_EQ(kept(gate), (pcl::Indices{2, 3, 6}));
}

TEST(RangeGate, LooksOnlyAtTheChosenPoints)
{
  RangeGate<GatePoint> gate;
  gate.setLimits(1, 5);
  gate.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{3, 1, 4}));
  EXPECT_EQ(kept(gate), (pcl::Indices{1}));
}

TEST(RangeGate, ReportsWhatItRemoved)
{
  RangeGate<GatePoint> gate(true);
  gate.setLimits(1, 5);
  EXPECT_EQ(kept(gate), (pcl::Indices{0, 1}));
  EXPECT_EQ(*gate.getRemovedIndices(), (pcl::Indices{2, 3, 4, 5, 6}));
  EXPECT_EQ(kept(gate), (pcl::Indices{0, 1}));
  EXPECT_EQ(gate.getRemovedIndices()->size(), 5u) << "and starts anew each time";
}

TEST(RangeGate, FiltersCloudsAsAPclFilter)
{
  RangeGate<GatePoint> gate;
  gate.setLimits(1, 5);
  pcl::Filter<GatePoint>& filter = gate;
  filter.setInputCloud(toCloud<GatePoint>(kPoints));
  pcl::PointCloud<GatePoint> output;
  filter.filter(output);
  EXPECT_EQ(pcl6d::toPoints(output), (pcl6d::Points{kPoints[0], kPoints[1]}));
}

TEST(RangeGate, KeepsCloudsOrganized)
{
  RangeGate<GatePoint> gate(true);
  gate.setLimits(1, 5);
  gate.setKeepOrganized(true);
  gate.setInputCloud(toCloud<GatePoint>(kPoints));
  pcl::PointCloud<GatePoint> output;
  gate.filter(output);
  ASSERT_EQ(output.size(), kPoints.size());
  EXPECT_EQ(output[1].z, -4);
  EXPECT_TRUE(std::isnan(output[3].x));
}

TEST(RangeGate, RefusesLimitsThatBreakTheirRule)
{
  RangeGate<GatePoint> gate;
  gate.setLimits(1, 5);
  for (const double bad : {-0.1, double{kNan}})
    EXPECT_NE(badArgumentOf([&] { gate.setLimits(bad, 2); }).find("min_range = "),
              std::string::npos);
  for (const double bad : {0.5, double{kNan}, -double{kInfinity}})
    EXPECT_NE(badArgumentOf([&] { gate.setLimits(1, bad); }).find("max_range = "),
              std::string::npos);
  EXPECT_EQ(kept(gate), (pcl::Indices{0, 1})) << "the old limits stay";
}

TEST(GateByRange, GivesThePointsOfTheGateInTheirOrder)
{
  EXPECT_EQ(pcl6d::gateByRange(kPoints, 1, 5), (pcl6d::Points{kPoints[0], kPoints[1]}));
  EXPECT_EQ(pcl6d::gateByRange(kPoints, 0, kInfinity).size(), 5u);
  EXPECT_TRUE(pcl6d::gateByRange({}, 0, 1).empty());
}
