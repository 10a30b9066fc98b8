// SPDX-License-Identifier: BSD-3-Clause
// What cannot be measured, and what is refused.
#include "room_pair.h"

#include <pcl6d/common/pose.h>

#include <algorithm>
#include <functional>

using Eigen::Isometry3d;
using pcl6d::evaluateIcpBasin;
using pcl6d::IcpBasin;
using pcl6d::IcpBasinOptions;
using pcl6d::IcpVariant;
using pcl6d::Metric;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::SearchMethod;
using pcl6d::test::badArgumentOf;
using pcl6d::test::evaluateRoom;
using pcl6d::test::kNan;
using pcl6d::test::nearStarts;
using pcl6d::test::room;
using pcl6d::test::RoomPair;

namespace {
std::string
doubtOf(const Points& target, const Points& source, const Isometry3d& guess)
{
  const IcpBasin basin =
      evaluateIcpBasin(target, source, guess, {IcpVariant()}, nearStarts());
  EXPECT_TRUE(basin.rows.empty());
  EXPECT_TRUE(basin.complete);
  return basin.best.at(0).doubt;
}
} // namespace

TEST(IcpBasin, DoubtsABestPoseThatIsNone)
{
  const RoomPair& pair = room();
  EXPECT_EQ(doubtOf(pair.target, pair.source, pcl6d::planarPose(100, 0, 0)),
            "ICP stopped: too few pairs");
  EXPECT_EQ(doubtOf({}, pair.source, pair.truth), "ICP stopped: too few pairs");
  EXPECT_EQ(doubtOf(pair.target, {}, pair.truth), "ICP stopped: too few pairs");

  Points line; // turns about a line change nothing
  for (int i = 0; i < 100; ++i)
    line.emplace_back(0.1F * static_cast<float>(i), 0.0F, 0.0F);
  EXPECT_NE(doubtOf(line, line, Isometry3d::Identity()).find("do not fix the pose"),
            std::string::npos);

  Random random(5);
  Points cloud; // all over the room, and none of its surfaces
  for (int i = 0; i < 1000; ++i)
    cloud.emplace_back(static_cast<float>(random.uniform(-4, 4)),
                       static_cast<float>(random.uniform(-3, 3)),
                       static_cast<float>(random.uniform(-0.5, 1.5)));
  Points far = cloud; // a few points overlap
  for (std::size_t i = 50; i < far.size(); ++i)
    far[i] += Eigen::Vector3f(100, 0, 0);
  EXPECT_NE(doubtOf(cloud, far, Isometry3d::Identity()).find("overlap 0.05"),
            std::string::npos);
}

TEST(IcpBasin, DoubtsPairsAsFarApartAsThoseOfUnrelatedPoints)
{
  IcpBasinOptions o = nearStarts();
  o.max_rms_share = 0.01;
  const IcpBasin basin = evaluateRoom({IcpVariant()}, o);
  EXPECT_TRUE(basin.rows.empty());
  EXPECT_NE(basin.best.at(0).doubt.find("unrelated points"), std::string::npos);
}

TEST(IcpBasin, DoubtsABestPoseThatIcpLeaves)
{
  const RoomPair& pair = room(); // from there points come to rest beside the truth
  const Isometry3d guess = pair.truth * pcl6d::planarPose(3, 1, 0.5);
  const std::string doubt = doubtOf(pair.target, pair.source, guess);
  EXPECT_EQ(doubt.rfind("ICP started in the pose found leaves it by 1.", 0), 0u)
      << doubt;
}

TEST(IcpBasin, SaysWhichBestPosesAreNotTheSame)
{
  const std::vector<IcpVariant> variants = {
      {Metric::kPoint, "quaternion", SearchMethod::kRemembered},
      {Metric::kPlane, "helix", SearchMethod::kRemembered}};
  IcpBasinOptions o = nearStarts();
  EXPECT_TRUE(evaluateRoom(variants, o).disagreements.empty());

  o.disagreement_sigmas = 1e-3;
  const IcpBasin basin = evaluateRoom(variants, o);
  ASSERT_EQ(basin.disagreements.size(), 1u);
  const auto& found = basin.disagreements[0];
  EXPECT_EQ(found.a, Metric::kPoint);
  EXPECT_EQ(found.b, Metric::kPlane);
  const auto distance = pcl6d::distanceBetween(basin.best[0].result.T_target_source,
                                               basin.best[1].result.T_target_source);
  EXPECT_EQ(found.distance.translation, distance.translation);
  EXPECT_EQ(found.distance.rotation, distance.rotation);
  EXPECT_EQ(basin.rows.size(), 2u) << "which of them is right cannot be known here";

  o.icp.max_iterations = 8; // too few for points: no pose to compare
  o.icp.max_distance_start = 0.5;
  EXPECT_TRUE(evaluateRoom(variants, o).disagreements.empty());
}

TEST(IcpBasin, MeasuresTheOtherMetricsIfOneFails)
{
  IcpBasinOptions o = nearStarts();
  o.icp.max_iterations = 8;       // too few for points,
  o.icp.max_distance_start = 0.5; // enough for planes from the truth
  const std::vector<IcpVariant> variants = {
      {Metric::kPoint, "quaternion", SearchMethod::kRemembered},
      {Metric::kPlane, "helix", SearchMethod::kRemembered}};
  const IcpBasin basin = evaluateRoom(variants, o);
  ASSERT_EQ(basin.best.size(), 2u);
  EXPECT_EQ(basin.best[0].doubt, "ICP stopped: iteration limit");
  EXPECT_EQ(basin.best[1].doubt, "");
  ASSERT_EQ(basin.rows.size(), 1u);
  EXPECT_EQ(basin.rows[0].variant, variants[1]);
}

TEST(IcpBasin, StopsWhenTheObserverSaysSo)
{
  const std::vector<IcpVariant> variants = {
      {Metric::kPoint, "quaternion", SearchMethod::kRemembered},
      {Metric::kPoint, "svd", SearchMethod::kRemembered}};
  std::vector<std::size_t> seen;
  const auto run = [&](std::size_t last) {
    seen.clear();
    return evaluateIcpBasin(room().target,
                            room().source,
                            room().truth,
                            variants,
                            nearStarts(),
                            [&](const pcl6d::Progress& progress) {
                              EXPECT_EQ(progress.total, 54u);
                              seen.push_back(progress.done);
                              return progress.done < last;
                            });
  };
  EXPECT_TRUE(run(1000).complete);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(seen.back(), 54u);
  const IcpBasin stopped = run(54);
  EXPECT_FALSE(stopped.complete);
  EXPECT_EQ(stopped.rows.size(), 1u);
  EXPECT_EQ(run(1).rows.size(), 0u);
}

TEST(IcpBasin, RefusesBadOptions)
{
  const auto message = [](const auto& change) {
    IcpBasinOptions o = nearStarts();
    change(o);
    return badArgumentOf([&] { evaluateRoom({IcpVariant()}, o); });
  };
  const double nan = kNan;
  const std::vector<std::pair<std::string, std::function<void(IcpBasinOptions&)>>> bad =
      {{"offset_xy = 0", [](auto& o) { o.offset_xy = 0; }},
       {"offset_xy = nan", [&](auto& o) { o.offset_xy = nan; }},
       {"offset_yaw = 4", [](auto& o) { o.offset_yaw = 4; }},
       {"offset_yaw = nan", [&](auto& o) { o.offset_yaw = nan; }},
       {"steps_xy = 0", [](auto& o) { o.steps_xy = 0; }},
       {"steps_xy = 4", [](auto& o) { o.steps_xy = 4; }},
       {"steps_yaw = -1", [](auto& o) { o.steps_yaw = -1; }},
       {"steps_xy = 1001", [](auto& o) { o.steps_xy = 1001; }},
       {"sigmas = 0", [](auto& o) { o.sigmas = 0; }},
       {"disagreement_sigmas = 0", [](auto& o) { o.disagreement_sigmas = 0; }},
       {"min_sigma_position = 0", [](auto& o) { o.min_sigma_position = 0; }},
       {"min_sigma_orientation = 0", [](auto& o) { o.min_sigma_orientation = 0; }},
       {"sigma_position = -1", [](auto& o) { o.sigma_position = -1; }},
       {"sigma_orientation = 0", [](auto& o) { o.sigma_orientation = 0; }},
       {"min_overlap = 2", [](auto& o) { o.min_overlap = 2; }},
       {"max_rms_share = nan", [&](auto& o) { o.max_rms_share = nan; }},
       {"normal_neighbours = 2", [](auto& o) { o.normal_neighbours = 2; }},
       {"max_iterations = 0", [](auto& o) { o.icp.max_iterations = 0; }}};
  for (const auto& [start, change] : bad)
    EXPECT_EQ(message(change).rfind(start + ", but must be", 0), 0u)
        << start << ": " << message(change);

  EXPECT_NE(badArgumentOf([] { evaluateRoom({}, nearStarts()); }), "");
  const IcpVariant unknown{Metric::kPlane, "svd", SearchMethod::kRemembered};
  EXPECT_NE(badArgumentOf([&] { evaluateRoom({unknown}, nearStarts()); }).find("svd"),
            std::string::npos);
  Isometry3d guess = Isometry3d::Identity();
  guess.translation().x() = nan;
  EXPECT_NE(badArgumentOf([&] {
              evaluateIcpBasin(
                  room().target, room().source, guess, {IcpVariant()}, nearStarts());
            }),
            "");
}
