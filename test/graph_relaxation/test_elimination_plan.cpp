// SPDX-License-Identifier: BSD-3-Clause
// The order of elimination changes no result, only what it costs.
#include "sparse/elimination_plan.h"

#include <gtest/gtest.h>

namespace {
using Couplings = std::vector<std::pair<std::size_t, std::size_t>>;

/** \return the blocks that the factor stores */
std::size_t
storedBlocks(std::size_t size, const Couplings& couplings)
{
  std::size_t blocks = 0;
  for (const auto& node :
       pcl6d::graph_relaxation::planElimination(size, couplings).supernodes)
    blocks += node.numColumns() * (node.numColumns() + 1) / 2 +
              node.numColumns() * node.rows.size();
  return blocks;
}
} // namespace

TEST(EliminationPlan, LeavesAStarWithoutFill)
{
  // In the order of the numbers the hub would come first and join all others: 5000
  // blocks. 199 are the fewest; supernodes may add some zeros.
  Couplings star;
  for (std::size_t i = 1; i < 100; ++i)
    star.emplace_back(0, i);
  EXPECT_LT(storedBlocks(100, star), 300u);
}

TEST(EliminationPlan, KeepsTheFillOfAGridLow)
{
  // A grid of n = side^2 blocks needs O(n log n); row by row it is n side = 64000.
  constexpr std::size_t kSide = 40;
  Couplings grid;
  for (std::size_t i = 0; i < kSide * kSide; ++i) {
    if (i % kSide + 1 < kSide)
      grid.emplace_back(i, i + 1);
    if (i + kSide < kSide * kSide)
      grid.emplace_back(i, i + kSide);
  }
  EXPECT_LT(storedBlocks(kSide * kSide, grid), 32000u);
}

TEST(EliminationPlan, CoversEveryBlockAndSupernodeOnce)
{
  Couplings chain;
  for (std::size_t i = 0; i + 1 < 50; ++i)
    chain.emplace_back(i, i + 1);
  const auto plan = pcl6d::graph_relaxation::planElimination(50, chain);
  std::vector<int> seen(50, 0), nodes(plan.supernodes.size(), 0);
  for (std::size_t place = 0; place < 50; ++place) {
    ++seen[plan.block_at[place]];
    EXPECT_EQ(plan.place_of[plan.block_at[place]], place);
  }
  for (const auto& subtree : plan.subtrees)
    for (const std::size_t node : subtree)
      ++nodes[node];
  for (const std::size_t node : plan.top)
    ++nodes[node];
  EXPECT_EQ(seen, std::vector<int>(50, 1));
  EXPECT_EQ(nodes, std::vector<int>(nodes.size(), 1));
}
