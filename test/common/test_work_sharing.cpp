// SPDX-License-Identifier: BSD-3-Clause
#include "support/rank_threads.h"

#include <pcl6d/common/points.h>

#include <gtest/gtest.h>

#include <atomic>
#include <limits>

namespace {
using namespace pcl6d;
using test::runRanks;

struct Named {
  std::string name;
  std::optional<double> value;
  std::vector<std::pair<int, Eigen::Isometry3d>> poses;
  Points points;
};

template <typename Archive>
void
packFields(Archive& archive, Named& named)
{
  archive(named.name, named.value, named.poses, named.points);
}

const std::vector<std::string> kNoErrors2 = {"", ""};
} // namespace

TEST(Packing, GivesBackWhatWasPacked)
{
  Named named;
  named.name = "a\0b";
  named.value = -0.0;
  named.poses.emplace_back(3, Eigen::Translation3d(1, 2, 3));
  named.points = {{1, 2, 3}, {std::numeric_limits<float>::quiet_NaN(), 0, 0}};
  Packer packer;
  packer(named, 7);
  Unpacker unpacker(packer.bytes);
  Named back;
  back.poses.resize(5);
  int seven = 0;
  unpacker(back, seven);
  unpacker.finish();
  EXPECT_EQ(back.name, named.name);
  EXPECT_TRUE(std::signbit(back.value.value()));
  ASSERT_EQ(back.poses.size(), 1u);
  EXPECT_TRUE(back.poses[0].second.isApprox(named.poses[0].second, 0));
  EXPECT_EQ(back.points[0], named.points[0]);
  EXPECT_TRUE(std::isnan(back.points[1].x()));
  EXPECT_EQ(seven, 7);
}

TEST(Packing, TellsBytesThatAreTooFewOrTooMany)
{
  Packer packer;
  packer(std::vector<double>{1, 2});
  for (const std::size_t size : {std::size_t{0}, std::size_t{4}, std::size_t{20}}) {
    const std::string cut = packer.bytes.substr(0, size);
    Unpacker unpacker(cut);
    std::vector<double> values;
    EXPECT_THROW(unpacker(values), IoFailed) << size;
  }
  Unpacker unpacker(packer.bytes);
  std::size_t size = 0;
  unpacker(size);
  EXPECT_THROW(unpacker.finish(), IoFailed);
}

TEST(WorkSharing, AllRanksHaveAllResultsAndEachItemIsComputedOnce)
{
  for (const std::size_t ranks : {1, 2, 3, 7}) {
    std::atomic<int> computed{0};
    const auto errors = runRanks(ranks, [&](WorkSharing& rank) {
      std::vector<std::string> results(20);
      sharedFor(&rank, 1, results, [&](std::size_t i) {
        ++computed;
        results[i] = std::to_string(i * i);
      });
      for (std::size_t i = 0; i < results.size(); ++i)
        EXPECT_EQ(results[i], std::to_string(i * i));
    });
    EXPECT_EQ(errors, std::vector<std::string>(ranks));
    EXPECT_EQ(computed, 20);
  }
}

TEST(WorkSharing, WithoutRanksThisProcessDoesAll)
{
  std::vector<int> results(5);
  sharedFor(nullptr, 2, results, [&](std::size_t i) { results[i] = 1; });
  EXPECT_EQ(results, std::vector<int>(5, 1));
}

TEST(WorkSharing, ItemsAreOfTheOwnersThatAreNamed)
{
  const auto errors = runRanks(2, [](WorkSharing& rank) {
    std::vector<std::size_t> owners(6);
    sharedFor(
        &rank,
        1,
        owners,
        [](std::size_t i) { return i / 3; },
        [&](std::size_t i) { owners[i] = rank.rank(); });
    EXPECT_EQ(owners, (std::vector<std::size_t>{0, 0, 0, 1, 1, 1}));
  });
  EXPECT_EQ(errors, kNoErrors2);
}

TEST(WorkSharing, WhatTheFirstSaysHolds)
{
  const auto errors = runRanks(
      3, [](WorkSharing& rank) { EXPECT_EQ(rank.fromFirst(rank.rank() + 10), 10u); });
  EXPECT_EQ(errors, std::vector<std::string>(3));
}

TEST(WorkSharing, BytesForTheFirstAreForNoOther)
{
  const auto errors = runRanks(2, [](WorkSharing& rank) {
    const auto all =
        rank.gather(rank.isFirst() ? "a" : "b", WorkSharing::Receivers::kFirst);
    EXPECT_EQ(all.size(), 2u);
    EXPECT_EQ(all[0] + all[1], rank.isFirst() ? "ab" : "b");
  });
  EXPECT_EQ(errors, kNoErrors2);
}

TEST(WorkSharing, TheErrorOfTheFirstItemIsThatOfAllRanks)
{
  for (const auto receivers :
       {WorkSharing::Receivers::kAll, WorkSharing::Receivers::kFirst}) {
    const auto errors = runRanks(3, [&](WorkSharing& rank) {
      WorkSharing::Loop loop;
      loop.count = 10;
      loop.owner = [](std::size_t i) { return i % 3; };
      loop.compute = [](std::size_t i) {
        if (i >= 4)
          throw BadArgument("item " + std::to_string(i));
      };
      loop.give = [](std::size_t, Packer&) {};
      loop.take = [](std::size_t, Unpacker&) {};
      loop.receivers = receivers;
      try {
        rank.run(loop, 1);
      } catch (const BadArgument&) { // its own
        EXPECT_EQ(rank.rank(), 1u);
        throw;
      }
    });
    EXPECT_EQ(errors, std::vector<std::string>(3, "item 4"));
  }
}

TEST(WorkSharing, ARankThatFailsBetweenLoopsEndsTheOthers)
{
  const auto errors = runRanks(3, [](WorkSharing& rank) {
    rank.gather("");
    if (rank.rank() == 2)
      throw IoFailed("no file");
    rank.gather("");
    ADD_FAILURE() << "went on";
  });
  EXPECT_EQ(errors, std::vector<std::string>(3, "no file"));
}

TEST(WorkSharing, AfterAFailureNothingWaits)
{
  const auto errors = runRanks(2, [](WorkSharing& rank) {
    if (!rank.isFirst())
      throw IoFailed("no file");
    EXPECT_THROW(rank.gather(""), RankFailed);
    EXPECT_THROW(rank.gather(""), RankFailed); // alone
  });
  EXPECT_EQ(errors[0], "");
  EXPECT_EQ(errors[1], "no file");
}
