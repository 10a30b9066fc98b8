// SPDX-License-Identifier: BSD-3-Clause
// A run that goes on with what an interrupted one has done.
#include "registered_run.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/slam6d/run_journal.h>

namespace {
using pcl6d::IoFailed;
using pcl6d::RunJournal;
using pcl6d::ScanResult;
using pcl6d::Slam6D;
using pcl6d::Slam6DOptions;
using pcl6d::Slam6DResult;
using pcl6d::test::DriftingRun;
using pcl6d::test::expectSameBits;
using pcl6d::test::sameBits;

const DriftingRun&
journalRun()
{
  static const DriftingRun run = pcl6d::test::makeDriftingRun(7);
  return run;
}

const Slam6DResult&
undisturbed()
{
  static const Slam6DResult result = pcl6d::test::registered(journalRun());
  return result;
}

/** Counts what is computed, and what is known. */
class CountingJournal : public RunJournal {
public:
  using RunJournal::RunJournal;

  void
  keepMatched(std::size_t scan, std::uint64_t inputs, const ScanResult& result) override
  {
    ++matched_now;
    RunJournal::keepMatched(scan, inputs, result);
  }
  void
  keepRelaxed(std::uint64_t inputs, const Slam6DResult& result) override
  {
    ++relaxed_now;
    RunJournal::keepRelaxed(inputs, result);
  }

  int matched_now = 0;
  int relaxed_now = 0;
};

class RunJournalTest : public testing::Test {
protected:
  CountingJournal
  journal(const std::string& voxel = "auto") const
  {
    return {path, {{"version", "1"}, {"--voxel", voxel}}, {"a.pcd", "b.pcd", "c.pcd"}};
  }

  /** Runs until so many scans are matched, and then to the end if it is told no number. */
  Slam6DResult
  run(CountingJournal& journal,
      const DriftingRun& scans = journalRun(),
      std::size_t stop_after = 0,
      const Slam6DOptions& options = {}) const
  {
    Slam6D slam(options);
    slam.setMemory(&journal);
    for (std::size_t i = 0; i < scans.scans.size(); ++i)
      slam.addScan(scans.scans[i], scans.odometry[i]);
    slam.setObserver([&](std::size_t i, const ScanResult&) {
      if (i + 1 == stop_after)
        slam.cancel();
    });
    EXPECT_EQ(slam.optimize(), stop_after == 0);
    return slam.result();
  }

  /** A run before; 0: that was not interrupted. */
  void
  interruptedRun(std::size_t stop_after) const
  {
    auto before = journal();
    run(before, journalRun(), stop_after);
  }

  pcl6d::test::TempFolder folder;
  const std::filesystem::path path = folder / "journal";
};

void
expectSameRun(const Slam6DResult& a, const Slam6DResult& b)
{
  expectSameBits(a, b);
  for (std::size_t i = 0; i < a.scans.size(); ++i) {
    EXPECT_TRUE(sameBits(a.scans[i].matched_pose, b.scans[i].matched_pose)) << i;
    EXPECT_EQ(a.scans[i].covariance, b.scans[i].covariance) << i;
    EXPECT_EQ(a.scans[i].iterations, b.scans[i].iterations) << i;
  }
  ASSERT_EQ(a.links.size(), b.links.size());
  for (std::size_t k = 0; k < a.links.size(); ++k) {
    EXPECT_EQ(a.links[k].from, b.links[k].from);
    EXPECT_EQ(a.links[k].rms, b.links[k].rms);
    EXPECT_EQ(a.links[k].verdict, b.links[k].verdict);
    EXPECT_EQ(a.links[k].T_from_to.has_value(), b.links[k].T_from_to.has_value());
  }
  ASSERT_EQ(a.stages.size(), b.stages.size());
  for (std::size_t k = 0; k < a.stages.size(); ++k) {
    EXPECT_EQ(a.stages[k].rejection, b.stages[k].rejection);
    EXPECT_EQ(a.stages[k].agreement_after, b.stages[k].agreement_after);
    EXPECT_EQ(a.stages[k].history.size(), b.stages[k].history.size());
  }
  ASSERT_EQ(a.graph.links.size(), b.graph.links.size());
  for (std::size_t k = 0; k < a.graph.links.size(); ++k)
    EXPECT_EQ(a.graph.links[k].information, b.graph.links[k].information);
  EXPECT_EQ(a.verification->trust, b.verification->trust);
  EXPECT_EQ(a.verification->links.size(), b.verification->links.size());
}
} // namespace

TEST_F(RunJournalTest, InterruptedAfterAnyScanTheRunEndsWithTheSameBits)
{
  for (std::size_t stop = 1; stop < journalRun().scans.size(); ++stop) {
    {
      auto first = journal();
      run(first, journalRun(), stop);
      EXPECT_EQ(first.matched_now, static_cast<int>(stop));
    }
    auto second = journal();
    EXPECT_EQ(second.numMatched(), stop);
    expectSameRun(run(second), undisturbed());
    EXPECT_EQ(second.matched_now, static_cast<int>(journalRun().scans.size() - stop));
    second.remove();
  }
}

TEST_F(RunJournalTest, WhatIsDoneIsNotDoneAgain)
{
  {
    auto first = journal();
    run(first);
    EXPECT_EQ(first.relaxed_now, 1);
  }
  auto second = journal();
  expectSameRun(run(second), undisturbed());
  EXPECT_EQ(second.matched_now, 0);
  EXPECT_EQ(second.relaxed_now, 0);
}

TEST_F(RunJournalTest, ACutJournalCostsTheLastTaskAlone)
{
  interruptedRun(0);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 1);
  auto second = journal();
  expectSameRun(run(second), undisturbed());
  EXPECT_EQ(second.matched_now, 0);
  EXPECT_EQ(second.relaxed_now, 1);
}

TEST_F(RunJournalTest, GivenLinksMakeAnotherRelaxation)
{
  interruptedRun(0);
  auto second = journal();
  Slam6DOptions options;
  options.given_links = {{0, 5}};
  run(second, journalRun(), 0, options);
  EXPECT_EQ(second.matched_now, 0);
  EXPECT_EQ(second.relaxed_now, 1);
}

TEST_F(RunJournalTest, AChangedScanIsNamed)
{
  interruptedRun(4);
  DriftingRun changed = journalRun();
  changed.scans[2].front().x() += 0.001F;
  auto second = journal();
  try {
    run(second, changed);
    FAIL() << "a changed scan was taken";
  } catch (const IoFailed& e) {
    EXPECT_NE(std::string(e.what()).find("c.pcd: has changed"), std::string::npos)
        << e.what();
  }
}

TEST_F(RunJournalTest, AStepMeasuredByTrackingIsAnotherInput)
{
  interruptedRun(4);
  auto second = journal();
  Slam6D slam;
  slam.setMemory(&second);
  for (std::size_t i = 0; i < journalRun().scans.size(); ++i)
    slam.addScan(journalRun().scans[i],
                 journalRun().odometry[i],
                 "",
                 pcl6d::test::measuredStep(i == 2));
  try {
    slam.optimize();
    FAIL() << "a scan with a measured step was taken for one without";
  } catch (const IoFailed& e) {
    EXPECT_NE(std::string(e.what()).find("c.pcd: has changed"), std::string::npos)
        << e.what();
  }
}

TEST_F(RunJournalTest, ASubmapIsAnotherInput)
{
  interruptedRun(4);
  auto second = journal();
  Slam6D slam;
  slam.setMemory(&second);
  pcl6d::DriveContext drive;
  drive.submap = {{journalRun().scans[1], Eigen::Isometry3d::Identity()}};
  for (std::size_t i = 0; i < journalRun().scans.size(); ++i)
    slam.addScan(journalRun().scans[i],
                 journalRun().odometry[i],
                 "",
                 i == 2 ? drive : pcl6d::DriveContext());
  EXPECT_THROW(slam.optimize(), IoFailed);
}

TEST_F(RunJournalTest, OtherConditionsAreNamed)
{
  interruptedRun(2);
  try {
    journal("0.2");
    FAIL() << "a journal of other options was taken";
  } catch (const IoFailed& e) {
    EXPECT_NE(std::string(e.what()).find("--voxel was auto, and is 0.2 now"),
              std::string::npos)
        << e.what();
  }
}

TEST_F(RunJournalTest, AResultThatCannotBeKeptIsNotComputedTwice)
{
  /** As on a full disk, until there is room. */
  class FullDisk : public CountingJournal {
  public:
    using CountingJournal::CountingJournal;
    void
    keepMatched(std::size_t scan,
                std::uint64_t inputs,
                const ScanResult& result) override
    {
      if (full && scan == 3) {
        full = false;
        throw IoFailed("No space left on device");
      }
      CountingJournal::keepMatched(scan, inputs, result);
    }
    bool full = true;
  };
  FullDisk disk(path, {{"version", "1"}});
  Slam6D slam;
  slam.setMemory(&disk);
  for (std::size_t i = 0; i < journalRun().scans.size(); ++i)
    slam.addScan(journalRun().scans[i], journalRun().odometry[i]);
  EXPECT_THROW(slam.optimize(), IoFailed);
  EXPECT_TRUE(slam.optimize()); // there is room again
  expectSameRun(slam.result(), undisturbed());
}

TEST_F(RunJournalTest, MatchesAgainstRelaxedScansAreNotThoseOfOneGo)
{
  const auto addTo = [](Slam6D& slam, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      slam.addScan(journalRun().scans[i], journalRun().odometry[i]);
  };
  {
    auto first = journal();
    Slam6D slam;
    slam.setMemory(&first);
    addTo(slam, 0, 4);
    EXPECT_TRUE(slam.optimize());
    addTo(slam, 4, 7);
    EXPECT_TRUE(slam.optimize());
    EXPECT_EQ(first.matched_now, 7);
  }
  auto second = journal();
  EXPECT_THROW(run(second), IoFailed); // scan 4 was matched against other poses
}

TEST_F(RunJournalTest, LeavesNoFileWhereNothingWasDone)
{
  const auto unused = journal();
  EXPECT_FALSE(std::filesystem::exists(path));
}
