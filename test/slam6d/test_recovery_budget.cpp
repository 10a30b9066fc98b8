// SPDX-License-Identifier: BSD-3-Clause
// The budget of a bounded recovery: a clock that counts matches, on which everything draws.
#include "recovery/recovery_budget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

using pcl6d::RecoveryLeftOut;
using pcl6d::ScanResult;
using pcl6d::ScanState;
using pcl6d::slam6d::RecoveryBudget;
using pcl6d::slam6d::searchesInVain;

namespace {
constexpr std::size_t kSearch = 24, kPair = 5; // [matches]
constexpr std::size_t kLeast = 64;             // [matches] of a short run

/** Scans matched one by one; each n-th is lost. */
std::vector<ScanResult>
scansWithLost(std::size_t count, std::size_t every)
{
  std::vector<ScanResult> scans(count);
  for (std::size_t i = 0; i < count; ++i)
    scans[i].state = (i + 1) % every == 0 ? ScanState::kPredicted : ScanState::kMatched;
  return scans;
}

RecoveryBudget
budgetOf(const std::vector<ScanResult>& scans)
{
  RecoveryBudget budget;
  budget.begin(scans);
  return budget;
}
} // namespace

namespace {
/** \return pairs of scans, others in each round */
std::vector<std::pair<std::size_t, std::size_t>>
somePairs(std::size_t count, int round)
{
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t k = 0; k < count; ++k)
    pairs.emplace_back(k, 1000 * (static_cast<std::size_t>(round) + 1) + k);
  return pairs;
}
} // namespace

TEST(RecoveryBudget, IsTwoMatchesForEachRegisteredScanAndAtLeastAFew)
{
  for (const std::size_t count : {1U, 20U, 32U, 33U, 500U})
    EXPECT_EQ(budgetOf(scansWithLost(count, 1000)).left(), std::max(kLeast, 2 * count))
        << count;
  EXPECT_EQ(budgetOf({}).left(), kLeast);
  EXPECT_EQ(RecoveryBudget().left(), 0U) << "before it begins";
}

TEST(RecoveryBudget, BeginsWithTheSearchesThatFailed)
{
  for (const std::size_t count : {10U, 40U, 100U, 1000U}) {
    const auto scans = scansWithLost(count, 4);
    const std::size_t lost = count / 4, registered = count - lost;
    const std::size_t in_vain = searchesInVain(scans);
    EXPECT_EQ(in_vain, std::min(lost, std::max<std::size_t>(2, registered / kSearch)));
    const RecoveryBudget budget = budgetOf(scans);
    EXPECT_EQ(budget.left(), std::max(kLeast, 2 * registered) - kSearch * in_vain);
    EXPECT_EQ(budget.leftOut().searches, lost - in_vain);
  }
}

TEST(RecoveryBudget, OfScansLostInARowEverFewerAreSearchedFor)
{
  std::vector<ScanResult> scans(200); // all but the first lost
  scans[0].state = ScanState::kFixed;
  for (std::size_t i = 1; i < scans.size(); ++i)
    scans[i].state = ScanState::kPredicted;
  EXPECT_EQ(searchesInVain(scans), 2U);
  EXPECT_EQ(budgetOf(scans).left(), kLeast - 2 * kSearch);
}

// The law: whatever is asked for, in whatever order, no more is spent than there was.
TEST(RecoveryBudget, IsNeverOverdrawn)
{
  for (const std::size_t every : {1U, 2U, 5U, 50U})
    for (const std::size_t count : {3U, 20U, 60U, 400U}) {
      const auto scans = scansWithLost(count, every);
      const auto registered = static_cast<std::size_t>(
          std::count_if(scans.begin(), scans.end(), [](const ScanResult& scan) {
            return scan.state == ScanState::kMatched;
          }));
      RecoveryBudget budget = budgetOf(scans);
      std::size_t spent = kSearch * searchesInVain(scans);
      for (int round = 0; round < 5; ++round) {
        const std::size_t pairs = budget.pairsLeft();
        budget.spendPairs(somePairs(pairs, round), 3);
        spent += kPair * pairs;
        spent += budget.spendSecondLook(registered) ? registered : 0;
      }
      EXPECT_LE(spent, std::max(kLeast, 2 * registered)) << count << ", " << every;
      EXPECT_EQ(budget.leftOut().pairs, 15U);
    }
}

TEST(RecoveryBudget, NotesWhatItDoesNotPayFor)
{
  RecoveryBudget budget = budgetOf(scansWithLost(20, 1000));
  EXPECT_TRUE(budget.spendSecondLook(20));
  EXPECT_FALSE(budget.leftOut().is_second_look);
  budget.spendPairs(somePairs(budget.pairsLeft(), 0), 0);
  EXPECT_EQ(budget.pairsLeft(), 0U);
  EXPECT_FALSE(budget.spendSecondLook(20));
  EXPECT_TRUE(budget.leftOut().is_second_look);
  budget.leaveOut(4);
  EXPECT_EQ(budget.leftOut().scans, 4U);
  budget.begin(scansWithLost(20, 1000)); // another run with more scans
  EXPECT_FALSE(budget.leftOut().is_second_look);
  EXPECT_EQ(budget.leftOut().scans + budget.leftOut().pairs, 0U);
  EXPECT_EQ(budget.left(), kLeast);
}

namespace {
/** Hands the values of the first process to the others, in order. */
class Wire {
public:
  std::size_t
  operator()(std::size_t number)
  {
    return std::size_t(value({number}).front());
  }
  std::vector<std::size_t>
  operator()(const std::vector<std::size_t>& numbers)
  {
    return value(numbers);
  }
  bool is_first = true;

private:
  std::vector<std::size_t>
  value(const std::vector<std::size_t>& own)
  {
    if (is_first)
      sent_.push_back(own);
    return is_first ? own : sent_[next_++];
  }
  std::vector<std::vector<std::size_t>> sent_;
  std::size_t next_ = 0;
};
} // namespace

TEST(RecoveryBudget, IsTakenOverFromTheFirstProcess)
{
  RecoveryBudget first = budgetOf(scansWithLost(100, 10)), other;
  first.spendPairs({{2, 5}, {0, 7}}, 0);
  other.spendPairs({{1, 2}}, 0);
  Wire wire;
  const auto send = [&](const auto& value) { return wire(value); };
  first.exchange(send);
  wire.is_first = false;
  other.exchange(send);
  EXPECT_EQ(other.left(), first.left());
  EXPECT_EQ(other.paidPairs(), first.paidPairs());
  EXPECT_EQ(first.paidPairs().size(), 2U);
}
