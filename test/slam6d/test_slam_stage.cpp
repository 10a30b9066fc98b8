// SPDX-License-Identifier: BSD-3-Clause
#include "ring_run.h"

#include <pcl6d/common/error.h>

#include <functional>
#include <memory>
#include <utility>

using pcl6d::BadArgument;
using pcl6d::LinkKind;
using pcl6d::Points;
using pcl6d::Slam6D;
using pcl6d::Slam6DOptions;
using pcl6d::Slam6DResult;
using pcl6d::SlamStage;
using pcl6d::test::DriftingRun;
using pcl6d::test::expectSameBits;
using pcl6d::test::registered;
using pcl6d::test::sameBits;

namespace {
/** A stage that does what a test wants. */
class AnyStage : public SlamStage {
public:
  using Work = std::function<Report(const std::vector<const Points*>&,
                                    Slam6DResult&,
                                    const pcl6d::ProgressCallback&)>;
  explicit AnyStage(Work work) : work_(std::move(work)) {}

  std::string
  name() const override
  {
    return "mine";
  }

  Report
  run(const std::vector<const Points*>& scans,
      Slam6DResult& result,
      const pcl6d::ProgressCallback& report) override
  {
    return work_(scans, result, report);
  }

private:
  Work work_;
};

const DriftingRun&
smallRing()
{
  static const DriftingRun run = pcl6d::test::makeRingRun(8);
  return run;
}

/** A run with a stage. */
Slam6D
runWith(AnyStage::Work work, SlamStage::Place place)
{
  Slam6D slam;
  slam.addStage(std::make_shared<AnyStage>(std::move(work)), place);
  for (std::size_t i = 0; i < smallRing().scans.size(); ++i)
    slam.addScan(smallRing().scans[i], smallRing().odometry[i]);
  return slam;
}
} // namespace

TEST(SlamStage, SeesReducedScansAndMatchedPoses)
{
  std::size_t calls = 0;
  Slam6D slam = runWith(
      [&](const auto& scans, auto& result, const auto&) {
        ++calls;
        EXPECT_EQ(scans.size(), smallRing().scans.size());
        for (std::size_t i = 0; i < scans.size(); ++i) {
          EXPECT_EQ(scans[i]->size(), result.scans[i].reduced);
          EXPECT_TRUE(
              sameBits(result.scans[i].matched_pose, result.scans[i].T_world_scan));
        }
        EXPECT_TRUE(result.graph.links.empty());
        return SlamStage::Report();
      },
      SlamStage::Place::kAfterMatching);
  EXPECT_TRUE(slam.optimize());
  EXPECT_EQ(calls, 1U);
  expectSameBits(slam.result(), registered(smallRing())); // it changed nothing
}

TEST(SlamStage, LinksAreUsedAsGivenOnes)
{
  Slam6D slam = runWith(
      [](const auto&, auto&, const auto&) {
        SlamStage::Report report;
        report.links = {{0, 7}};
        return report;
      },
      SlamStage::Place::kAfterMatching);
  EXPECT_TRUE(slam.optimize());
  Slam6DOptions options;
  options.given_links = {{0, 7}};
  expectSameBits(slam.result(), registered(smallRing(), options));
}

TEST(SlamStage, LinksAreGivenAnewInEachRun)
{
  std::vector<std::size_t> sizes;
  Slam6D slam;
  slam.addStage(std::make_shared<AnyStage>([&](const auto& scans, auto&, const auto&) {
                  sizes.push_back(scans.size());
                  SlamStage::Report report;
                  report.links = {{0, scans.size() - 1}};
                  return report;
                }),
                SlamStage::Place::kAfterMatching);
  const auto countGiven = [&] {
    std::size_t given = 0;
    for (const auto& link : slam.result().links)
      given += link.kind == LinkKind::kGiven ? 1 : 0;
    return given;
  };
  for (std::size_t i = 0; i < smallRing().scans.size(); ++i) {
    slam.addScan(smallRing().scans[i], smallRing().odometry[i]);
    if (i == 5) {
      EXPECT_TRUE(slam.optimize());
      EXPECT_EQ(countGiven(), 1U);
    }
  }
  EXPECT_TRUE(slam.optimize());
  EXPECT_EQ(countGiven(), 1U); // that of 0 and 5 is not kept
  EXPECT_EQ(sizes, (std::vector<std::size_t>{6, 8}));
  EXPECT_TRUE(slam.optimize()); // nothing is left to do
  EXPECT_EQ(sizes.size(), 2U);
}

TEST(SlamStage, WithoutPosesItRunsInTheOrderOfTheScans)
{
  Slam6DOptions options;
  options.initial_guess = pcl6d::InitialGuess::kGlobal;
  options.order_first = true;
  std::size_t calls = 0;
  Slam6D slam(options);
  slam.addStage(std::make_shared<AnyStage>([&](const auto& scans, auto&, const auto&) {
                  EXPECT_EQ(scans.size(), 4U);
                  ++calls;
                  return SlamStage::Report();
                }),
                SlamStage::Place::kAfterMatching);
  for (std::size_t i = 0; i < 4; ++i)
    slam.addScan(smallRing().scans[i], Eigen::Isometry3d::Identity());
  EXPECT_TRUE(slam.optimize());
  EXPECT_LE(calls, 1U); // of the order of the scans, if that was not given up
}

TEST(SlamStage, MovesScansBeforeTheVerdict)
{
  const Eigen::Isometry3d up(Eigen::Translation3d(0, 0, 0.5));
  Slam6D slam = runWith(
      [&](const auto&, auto& result, const auto&) {
        EXPECT_FALSE(result.graph.links.empty()); // relaxed
        EXPECT_FALSE(result.verification);
        result.scans.back().T_world_scan = up * result.scans.back().T_world_scan;
        return SlamStage::Report();
      },
      SlamStage::Place::kAfterRelaxation);
  EXPECT_TRUE(slam.optimize());
  EXPECT_FALSE(slam.result().trusted()); // which sees that the scan hangs in the air
}

TEST(SlamStage, WhatItRejectsIsAsBefore)
{
  Slam6D slam = runWith(
      [](const auto&, auto& result, const auto&) {
        for (auto& scan : result.scans)
          scan.T_world_scan.setIdentity();
        SlamStage::Report report;
        report.accepted = false;
        report.links = {{0, 3}};
        return report;
      },
      SlamStage::Place::kAfterRelaxation);
  EXPECT_TRUE(slam.optimize());
  expectSameBits(slam.result(), registered(smallRing()));
}

TEST(SlamStage, CancelledInItChangesNothingAndGoesOn)
{
  bool is_first = true;
  Slam6D* running = nullptr;
  Slam6D slam = runWith(
      [&](const auto&, auto& result, const auto& report) {
        if (std::exchange(is_first, false)) {
          result.scans.back().T_world_scan.setIdentity();
          running->cancel();
        }
        report({"mine", 0, 1});
        return SlamStage::Report();
      },
      SlamStage::Place::kAfterMatching);
  running = &slam;
  EXPECT_FALSE(slam.optimize());
  EXPECT_FALSE(
      sameBits(slam.result().scans.back().T_world_scan, Eigen::Isometry3d::Identity()));
  EXPECT_TRUE(slam.optimize());
  expectSameBits(slam.result(), registered(smallRing()));
}

TEST(SlamStage, RefusesWhatNoRunCanUse)
{
  EXPECT_THROW(Slam6D().addStage(nullptr, SlamStage::Place::kAfterMatching),
               BadArgument);
  const auto expectRefused = [](AnyStage::Work work) {
    Slam6D slam = runWith(std::move(work), SlamStage::Place::kAfterMatching);
    EXPECT_THROW(slam.optimize(), BadArgument);
  };
  expectRefused([](const auto&, auto& result, const auto&) {
    result.scans.pop_back();
    return SlamStage::Report();
  });
  expectRefused([](const auto&, auto& result, const auto&) {
    result.scans[1].T_world_scan.linear() *= 2;
    return SlamStage::Report();
  });
  expectRefused([](const auto&, auto&, const auto&) {
    SlamStage::Report report;
    report.links = {{0, 99}};
    return report;
  });
  Slam6D late =
      runWith([](const auto&, auto&, const auto&) { return SlamStage::Report(); },
              SlamStage::Place::kAfterMatching);
  EXPECT_TRUE(late.optimize());
  EXPECT_THROW(late.addStage(std::make_shared<AnyStage>(AnyStage::Work()),
                             SlamStage::Place::kAfterMatching),
               BadArgument);
}
