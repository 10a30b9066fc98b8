// SPDX-License-Identifier: BSD-3-Clause
// Memory that lies in a file, and sizes as they are typed.
#include "common/app.h"
#include "common/process/memory_budget.h"
#include "common/process/scratch_arena.h"
#include "support/temp_folder.h"

#include <pcl6d/common/random.h>

#include <gtest/gtest.h>

#include <csignal>
#include <cstring>
#include <fstream>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace {
using pcl6d::app::machineMemory;
using pcl6d::app::memorySize;
using pcl6d::app::ScratchArena;
using pcl6d::app::UsageError;

constexpr std::size_t kMega = std::size_t{1} << 20;

/** \return [bytes] of files that the process has in memory */
std::size_t
residentOfFiles()
{
  std::ifstream statm("/proc/self/statm");
  std::size_t size = 0, resident = 0, shared = 0;
  statm >> size >> resident >> shared;
  return shared * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

std::string
message(const std::string& size)
{
  try {
    memorySize(size);
  } catch (const UsageError& e) {
    return e.what();
  }
  return "";
}
} // namespace

TEST(ScratchArena, BlocksKeepWhatIsInThemWhenTheirPagesAreLetGo)
{
  const pcl6d::test::TempFolder folder;
  ScratchArena arena(folder.path());
  auto* const block = static_cast<unsigned char*>(arena.allocate(100 * kMega));
  ASSERT_NE(block, nullptr);
  for (std::size_t i = 0; i < 100 * kMega; ++i)
    block[i] = static_cast<unsigned char>(i * 31 >> 7);
  const std::size_t full = residentOfFiles();
  arena.letGo();
  const std::size_t empty = residentOfFiles();
  EXPECT_GE(full - empty, 95 * kMega);
  for (std::size_t i = 0; i < 100 * kMega; ++i)
    ASSERT_EQ(block[i], static_cast<unsigned char>(i * 31 >> 7)) << i;
}

TEST(ScratchArena, LeavesNoFile)
{
  const pcl6d::test::TempFolder folder;
  ScratchArena arena(folder.path());
  EXPECT_EQ(arena.size(), 0U);
  ASSERT_NE(arena.allocate(1), nullptr);
  EXPECT_GT(arena.size(), 0U);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(ScratchArena, OwnsItsBlocksAlone)
{
  const pcl6d::test::TempFolder folder;
  ScratchArena arena(folder.path());
  const int other = 0;
  EXPECT_FALSE(arena.owns(&other));
  EXPECT_FALSE(arena.owns(nullptr));
  EXPECT_TRUE(arena.owns(arena.allocate(5000)));
}

TEST(ScratchArena, TakesFreedRoomAgain)
{
  const pcl6d::test::TempFolder folder;
  ScratchArena arena(folder.path());
  std::vector<void*> blocks;
  for (int i = 0; i < 64; ++i)
    blocks.push_back(arena.allocate(kMega));
  const std::size_t size = arena.size();
  for (int i = 0; i < 64; i += 2)
    arena.free(blocks[static_cast<std::size_t>(i)]);
  for (int i = 1; i < 64; i += 2)
    arena.free(blocks[static_cast<std::size_t>(i)]);
  void* const all = arena.allocate(64 * kMega); // joined again
  EXPECT_NE(all, nullptr);
  EXPECT_EQ(arena.size(), size);
}

TEST(ScratchArena, BlocksNeverOverlapWithSeveralThreads)
{
  const pcl6d::test::TempFolder folder;
  ScratchArena arena(folder.path());
  std::atomic<int> wrong{0};
  const auto work = [&](unsigned char mark) {
    pcl6d::Random random(mark);
    std::vector<std::pair<unsigned char*, std::size_t>> blocks;
    for (int i = 0; i < 2000; ++i) {
      const auto size = static_cast<std::size_t>(random.uniform(1, 60000));
      auto* const block = static_cast<unsigned char*>(arena.allocate(size));
      std::memset(block, mark, size);
      blocks.emplace_back(block, size);
      if (i % 3 == 0)
        arena.letGo();
      if (i % 2 == 0)
        continue;
      const auto place = static_cast<std::size_t>(random.uniform() * blocks.size());
      for (std::size_t k = 0; k < blocks[place].second; ++k)
        wrong += blocks[place].first[k] != mark;
      arena.free(blocks[place].first);
      blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(place));
    }
  };
  std::thread first(work, 1), second(work, 2);
  first.join();
  second.join();
  EXPECT_EQ(wrong, 0);
}

TEST(ScratchArena, AFullDiskIsNoBlockAndNoCrash)
{
  const pcl6d::test::TempFolder folder;
  ScratchArena arena(folder.path());
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{8 * kMega, before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);
  void* const fits = arena.allocate(6 * kMega);
  void* const too_much = arena.allocate(6 * kMega);
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  ASSERT_NE(fits, nullptr);
  std::memset(fits, 1, 6 * kMega);
  EXPECT_EQ(too_much, nullptr);
  EXPECT_NE(arena.allocate(6 * kMega), nullptr); // there is room again
}

TEST(ScratchArena, AFolderThatIsNotThereGivesNoBlock)
{
  ScratchArena arena("/nowhere/at/all");
  EXPECT_EQ(arena.allocate(1), nullptr);
}

TEST(MemorySize, PowersOf1024)
{
  EXPECT_EQ(memorySize("1048576"), kMega);
  EXPECT_EQ(memorySize("1M"), kMega);
  EXPECT_EQ(memorySize("1.5 MiB"), 3 * kMega / 2);
  EXPECT_EQ(memorySize("2048k"), 2 * kMega);
  EXPECT_EQ(memorySize("0.25GB"), 256 * kMega);
  EXPECT_EQ(memorySize("7b"), 7U);
}

TEST(MemorySize, WhatIsNoneIsNamed)
{
  for (const char* word : {"", "M", "much", "1X", "1MM", "nan", "inf", "1 2"})
    EXPECT_NE(
        message(word).find("--memory = " + std::string(word) + ", but expected a size"),
        std::string::npos)
        << word << ": " << message(word);
  for (const char* word : {"0", "-1G", "0.1"})
    EXPECT_NE(message(word).find("but must be > 0"), std::string::npos) << word;
  EXPECT_NE(message("900T").find("but the machine has"), std::string::npos);
}

TEST(MemorySize, TheMachineHasMore)
{
  EXPECT_GT(machineMemory(), 256 * kMega);
}
