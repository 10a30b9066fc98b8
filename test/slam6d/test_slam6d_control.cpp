// SPDX-License-Identifier: BSD-3-Clause
#include "support/bits.h"
#include "support/drift.h"

#include <pcl6d/slam6d/slam6d.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <thread>
#include <vector>

using pcl6d::ScanResult;
using pcl6d::ScanState;
using pcl6d::Slam6D;
using pcl6d::Slam6DOptions;
using pcl6d::Slam6DResult;
using pcl6d::test::DriftingRun;
using pcl6d::test::sameBits;

namespace {
const DriftingRun&
sampleRun()
{
  static const DriftingRun run = pcl6d::test::makeDriftingRun(6);
  return run;
}

/** Scan by scan: what is later moved at once is another test's. */
Slam6DOptions
matchingAlone()
{
  Slam6DOptions options;
  options.loop_closing = pcl6d::LoopClosing::kNone;
  options.relaxation.reset();
  return options;
}

void
add(Slam6D& slam, std::size_t begin, std::size_t end)
{
  for (std::size_t i = begin; i < end; ++i)
    slam.addScan(sampleRun().scans[i], sampleRun().odometry[i]);
}

/** The result of a run in one go. */
const Slam6DResult&
whole()
{
  static const Slam6DResult result = [] {
    Slam6D slam(matchingAlone());
    add(slam, 0, 6);
    slam.optimize();
    return slam.result();
  }();
  return result;
}

void
expectWhole(const Slam6DResult& result, std::size_t count = 6)
{
  ASSERT_EQ(result.scans.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_TRUE(sameBits(result.scans[i].T_world_scan, whole().scans[i].T_world_scan));
    EXPECT_EQ(result.scans[i].state, whole().scans[i].state);
  }
}
} // namespace

TEST(Slam6DCancel, StopsAfterTheScanAndLeavesTheRestPredicted)
{
  Slam6D slam(matchingAlone());
  add(slam, 0, 6);
  slam.setObserver([&](std::size_t place, const ScanResult&) {
    if (place == 2)
      slam.cancel();
  });
  EXPECT_FALSE(slam.optimize());
  const auto& scans = slam.result().scans;
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_TRUE(sameBits(scans[i].T_world_scan, whole().scans[i].T_world_scan));
  Eigen::Isometry3d predicted = scans[2].T_world_scan;
  for (std::size_t i = 3; i < 6; ++i) {
    EXPECT_EQ(scans[i].state, ScanState::kPending);
    predicted =
        predicted * sampleRun().odometry[i - 1].inverse() * sampleRun().odometry[i];
    EXPECT_LT(pcl6d::distanceBetween(predicted, scans[i].T_world_scan).translation,
              1e-9);
  }
  EXPECT_FALSE(slam.result().trusted());

  EXPECT_TRUE(slam.optimize()) << "goes on";
  expectWhole(slam.result());
}

TEST(Slam6DCancel, OfTheLastScanDoesNotStopTheNextRun)
{
  // A request that comes with the last scan is fulfilled when the run ends.
  Slam6D slam(matchingAlone());
  add(slam, 0, 3);
  slam.setObserver([&](std::size_t place, const ScanResult&) {
    if (place == 2)
      slam.cancel();
  });
  EXPECT_TRUE(slam.optimize());
  add(slam, 3, 6);
  EXPECT_TRUE(slam.optimize());
  expectWhole(slam.result());
}

namespace {
/** Cancels a run at a report, and counts the later reports. */
struct CancelAt {
  std::string stage;
  std::size_t done;
  std::size_t later = 0;
  bool is_cancelled = false;

  void
  watch(Slam6D& slam)
  {
    slam.setProgressCallback([this, &slam](const pcl6d::Progress& now) {
      later += is_cancelled ? 1 : 0;
      if (!is_cancelled && now.stage == stage && now.done == done) {
        is_cancelled = true;
        slam.cancel();
      }
    });
  }
};
} // namespace

TEST(Slam6DCancel, StopsWhileScansArePrepared)
{
  for (const unsigned int num_threads : {1u, 2u, 4u})
    for (const CancelAt& wanted : {CancelAt{"reducing", 1},
                                   CancelAt{"reducing", 6},
                                   CancelAt{"preparing", num_threads},
                                   CancelAt{"preparing", 6}}) {
      SCOPED_TRACE(wanted.stage + ' ' + std::to_string(wanted.done) + ", threads " +
                   std::to_string(num_threads));
      Slam6DOptions options = matchingAlone();
      options.num_threads = num_threads;
      Slam6D slam(options);
      add(slam, 0, 6);
      CancelAt cancel = wanted;
      cancel.watch(slam);
      EXPECT_FALSE(slam.optimize());
      EXPECT_TRUE(cancel.is_cancelled);
      EXPECT_EQ(cancel.later, 0u) << "no further scan is prepared";
      for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(slam.result().scans[i].state, ScanState::kPending);
        EXPECT_TRUE(slam.result().scans[i].T_world_scan.isApprox(
            sampleRun().odometry[i], 1e-12));
      }
      std::vector<std::string> seen;
      slam.setProgressCallback([&](const pcl6d::Progress& now) {
        seen.push_back(now.stage + ' ' + std::to_string(now.done));
      });
      EXPECT_TRUE(slam.optimize());
      expectWhole(slam.result());
      const std::string again = cancel.stage + ' ' + std::to_string(cancel.done);
      EXPECT_EQ(std::count(seen.begin(), seen.end(), again), 0)
          << "prepared scans are kept";
    }
}

TEST(Slam6DCancel, OfAnotherThreadStopsWhileScansArePrepared)
{
  Slam6D slam(matchingAlone());
  add(slam, 0, 6);
  std::size_t reports = 0;
  slam.setProgressCallback([&](const pcl6d::Progress&) {
    ++reports;
    std::thread([&slam] { slam.cancel(); }).join();
  });
  EXPECT_FALSE(slam.optimize());
  EXPECT_EQ(reports, 1u);
  slam.setProgressCallback({});
  EXPECT_TRUE(slam.optimize());
  expectWhole(slam.result());
}

TEST(Slam6D, TakesScansOneAfterTheOther)
{
  Slam6D slam(matchingAlone());
  Slam6DOptions options =
      matchingAlone(); // those of the whole run: derived ones differ
  const auto& p = whole().parameters;
  options.min_range = p.min_range.value;
  options.max_range = p.max_range.value;
  options.voxel = p.voxel.value;
  options.max_distance = p.max_distance.value;
  options.max_distance_start = p.max_distance_start.value;
  slam = Slam6D(options);
  for (std::size_t i = 0; i < 6; ++i) {
    add(slam, i, i + 1);
    EXPECT_TRUE(slam.optimize());
  }
  expectWhole(slam.result());
  EXPECT_TRUE(slam.optimize()) << "nothing left to do";
  expectWhole(slam.result());
}

TEST(Slam6DProgress, CountsEveryScan)
{
  Slam6D slam(matchingAlone());
  add(slam, 0, 6);
  std::vector<pcl6d::Progress> seen;
  std::vector<pcl6d::Progress> matched;
  slam.setProgressCallback([&](const pcl6d::Progress& p) {
    (p.stage == "matching" ? matched : seen).push_back(p);
  });
  slam.optimize();
  ASSERT_EQ(matched.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(matched[i].done, i + 1);
    EXPECT_EQ(matched[i].total, 6u);
  }
  ASSERT_FALSE(seen.empty());
  EXPECT_EQ(seen.back().stage, "preparing");
  EXPECT_EQ(seen.back().done, 6u);
  EXPECT_EQ(seen.back().total, 6u);
}

TEST(Slam6DObserver, SeesEachScanAsItIsInTheResult)
{
  Slam6D slam(matchingAlone());
  add(slam, 0, 4);
  std::vector<ScanResult> seen;
  slam.setObserver([&](std::size_t place, const ScanResult& scan) {
    EXPECT_EQ(place, seen.size());
    seen.push_back(scan);
  });
  slam.optimize();
  ASSERT_EQ(seen.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(sameBits(seen[i].T_world_scan, slam.result().scans[i].T_world_scan));
    EXPECT_EQ(seen[i].state, slam.result().scans[i].state);
  }
}

TEST(Slam6DObserver, MayThrowAndTheRunGoesOnLater)
{
  Slam6D slam(matchingAlone());
  add(slam, 0, 6);
  slam.setObserver([](std::size_t place, const ScanResult&) {
    if (place == 2)
      throw std::runtime_error("disk full");
  });
  EXPECT_THROW(slam.optimize(), std::runtime_error);
  slam.setObserver({});
  EXPECT_TRUE(slam.optimize());
  expectWhole(slam.result());
}

TEST(ScanState, HasANameForEachState)
{
  EXPECT_STREQ(toString(ScanState::kPending), "pending");
  EXPECT_STREQ(toString(ScanState::kFixed), "fixed");
  EXPECT_STREQ(toString(ScanState::kMatched), "matched");
  EXPECT_STREQ(toString(ScanState::kUnconverged), "unconverged");
  EXPECT_STREQ(toString(ScanState::kPredicted), "predicted");
}
