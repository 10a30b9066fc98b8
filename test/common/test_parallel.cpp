// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/random.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <numeric>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace {
std::vector<double>
randomNumbers(std::size_t count)
{
  pcl6d::Random random(7);
  std::vector<double> numbers(count);
  for (auto& x : numbers)
    x = random.uniform(-1e6, 1e6);
  return numbers;
}

double
blockedSum(const std::vector<double>& numbers, unsigned int threads)
{
  constexpr std::size_t kBlock = 1024;
  std::vector<double> partials((numbers.size() + kBlock - 1) / kBlock);
  pcl6d::parallelBlocks(numbers.size(), kBlock, threads, [&](const pcl6d::Block& b) {
    for (std::size_t i = b.begin; i < b.end; ++i)
      partials[b.index] += numbers[i];
  });
  return pcl6d::mergeTree(partials, std::plus<double>());
}
} // namespace

TEST(ParallelFor, CallsEachIndexOnce)
{
  for (const unsigned int threads : {0u, 1u, 2u, 8u}) {
    std::vector<int> calls(1000);
    pcl6d::parallelFor(calls.size(), threads, [&](std::size_t i) { ++calls[i]; });
    EXPECT_EQ(calls, std::vector<int>(1000, 1)) << threads << " threads";
  }
}

TEST(ParallelFor, DoesNothingForZeroItems)
{
  pcl6d::parallelFor(0, 2, [](std::size_t) { FAIL(); });
}

TEST(ParallelFor, ThrowsTheErrorOfTheLowestIndex)
{
  for (const unsigned int threads : {1u, 4u})
    try {
      pcl6d::parallelFor(100, threads, [](std::size_t i) {
        if (i % 10 == 7)
          throw std::runtime_error(std::to_string(i));
      });
      FAIL() << "nothing thrown";
    } catch (const std::runtime_error& e) {
      EXPECT_STREQ(e.what(), "7");
    }
}

TEST(ParallelFor, MayNestAndRunFromSeveralThreads)
{
  std::vector<std::atomic<int>> calls(3 * 7 * 50);
  std::vector<std::thread> callers;
  for (std::size_t a = 0; a < 3; ++a)
    callers.emplace_back([&, a] {
      pcl6d::parallelFor(7, 4, [&](std::size_t b) {
        pcl6d::parallelFor(
            50, 3, [&](std::size_t c) { ++calls[(a * 7 + b) * 50 + c]; });
      });
    });
  for (auto& caller : callers)
    caller.join();
  for (const auto& count : calls)
    EXPECT_EQ(count, 1);
}

TEST(ParallelFor, ManyShortLoopsAllComplete)
{
  std::size_t sum = 0;
  for (std::size_t round = 0; round < 20000; ++round) {
    std::atomic<std::size_t> steps{0};
    pcl6d::parallelFor(3, 2, [&](std::size_t) { ++steps; });
    sum += steps;
  }
  EXPECT_EQ(sum, 60000u);
}

// A forked process has none of the pool's threads, and must not wait for them at its end.
TEST(ParallelFor, WorksInAForkedProcess)
{
  const auto sum = [] {
    std::atomic<int> total{0};
    pcl6d::parallelFor(100, 4, [&](std::size_t i) { total += static_cast<int>(i); });
    return total.load();
  };
  EXPECT_EQ(sum(), 4950);
  const pid_t child = fork();
  if (child == 0)
    std::exit(sum() == 4950 ? 0 : 1); // with the destructors of statics
  int status = -1;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(sum(), 4950);
}

TEST(BlockedSum, HasTheSameBitsForEveryThreadCount)
{
  const auto numbers = randomNumbers(100003);
  const double expected = blockedSum(numbers, 1);
  for (const unsigned int threads : {2u, 3u, 8u})
    EXPECT_EQ(blockedSum(numbers, threads), expected) << threads << " threads";
  const double plain = std::accumulate(numbers.begin(), numbers.end(), 0.0);
  // The partial sums reach 3e8, half an ulp of which is 3e-8; over 1e5 additions this
  // walks to 1e-5.
  EXPECT_NEAR(expected, plain, 1e-4);
}

TEST(MergeTree, KeepsTheOrderOfItsInput)
{
  for (const std::size_t count : {1u, 2u, 3u, 7u, 8u}) {
    std::vector<std::string> letters;
    std::string expected;
    for (std::size_t i = 0; i < count; ++i)
      expected += letters.emplace_back(1, static_cast<char>('a' + i));
    EXPECT_EQ(pcl6d::mergeTree(letters, std::plus<std::string>()), expected);
  }
  EXPECT_EQ(pcl6d::mergeTree(std::vector<int>(), std::plus<int>()), 0);
}
