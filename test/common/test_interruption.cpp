// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/interruption.h>
#include <pcl6d/common/parallel.h>

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

TEST(Interruption, LoopsBeginNoStepAfterTheFlagIsSet)
{
  for (const unsigned int threads : {1u, 2u, 8u}) {
    std::atomic<bool> stop{false};
    std::atomic<int> after{0};
    const pcl6d::StopScope scope(stop);
    EXPECT_THROW(pcl6d::parallelFor(100000,
                                    threads,
                                    [&](std::size_t i) {
                                      after += stop;
                                      if (i == 100)
                                        stop = true;
                                    }),
                 pcl6d::Interrupted);
    EXPECT_LT(after, 8) << threads << " threads"; // those that had begun
    EXPECT_THROW(pcl6d::parallelBlocks(
                     10, 2, threads, [](const pcl6d::Block&) { ADD_FAILURE(); }),
                 pcl6d::Interrupted);
  }
}

TEST(Interruption, LoopsInsideStepsStop)
{
  for (const unsigned int threads : {1u, 2u, 8u}) {
    std::atomic<bool> stop{false};
    const pcl6d::StopScope scope(stop);
    std::atomic<int> ended{0};
    EXPECT_THROW(pcl6d::parallelFor(8,
                                    threads,
                                    [&](std::size_t) {
                                      pcl6d::parallelFor(
                                          1000, threads, [&](std::size_t i) {
                                            if (i == 10)
                                              stop = true;
                                          });
                                      ++ended;
                                    }),
                 pcl6d::Interrupted);
    EXPECT_EQ(ended, 0) << threads << " threads";
  }
}

TEST(Interruption, HelpersForgetTheFlagAfterTheLoop)
{
  std::atomic<bool> stop{true};
  for (int round = 0; round < 20; ++round) {
    {
      const pcl6d::StopScope scope(stop);
      EXPECT_THROW(pcl6d::parallelFor(100, 4, [](std::size_t) {}), pcl6d::Interrupted);
    }
    std::atomic<int> calls{0};
    pcl6d::parallelFor(100, 4, [&](std::size_t) {
      pcl6d::throwIfStopped();
      ++calls;
    });
    EXPECT_EQ(calls, 100);
  }
}

TEST(Interruption, AnInnerScopeReplacesTheOuterFlagUntilItsEnd)
{
  const std::atomic<bool> stop{true}, go{false};
  const pcl6d::StopScope outer(stop);
  EXPECT_THROW(pcl6d::throwIfStopped(), pcl6d::Interrupted);
  {
    const pcl6d::StopScope inner(go);
    EXPECT_NO_THROW(pcl6d::throwIfStopped());
    EXPECT_NO_THROW(pcl6d::parallelFor(100, 2, [](std::size_t) {}));
  }
  EXPECT_THROW(pcl6d::throwIfStopped(), pcl6d::Interrupted);
}

TEST(Interruption, AnErrorBeforeTheStopIsThrownAsBefore)
{
  const std::atomic<bool> go{false};
  const pcl6d::StopScope scope(go);
  for (const unsigned int threads : {1u, 4u})
    EXPECT_THROW(pcl6d::parallelFor(100,
                                    threads,
                                    [](std::size_t i) {
                                      if (i == 7)
                                        throw std::runtime_error("7");
                                    }),
                 std::runtime_error);
}
