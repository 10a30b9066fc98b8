// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/random.h>
#include <pcl6d/common/voxel_numbers.h>

#include <gtest/gtest.h>

#include <limits>
#include <map>

namespace {
using namespace pcl6d;

TEST(VoxelNumbers, CountsFromZeroInTheOrderOfFirstSight)
{
  VoxelNumbers numbers;
  EXPECT_EQ(numbers.size(), 0U);
  EXPECT_EQ(numbers.add(7), std::make_pair(std::size_t{0}, true));
  EXPECT_EQ(numbers.add(0), std::make_pair(std::size_t{1}, true)); // also a key
  EXPECT_EQ(numbers.add(7), std::make_pair(std::size_t{0}, false));
  EXPECT_EQ(numbers.add(std::numeric_limits<VoxelKey>::max()),
            std::make_pair(std::size_t{2}, true));
  EXPECT_EQ(numbers.size(), 3U);
}

TEST(VoxelNumbers, AgreesWithAMapOverManyThatRepeat)
{
  VoxelNumbers numbers;
  std::map<VoxelKey, std::size_t> expected;
  Random random(5);
  for (int i = 0; i < 200000; ++i) {
    // Neighbouring cells, as points give, with runs in the lowest bits of each coordinate.
    const Eigen::Vector3f p(static_cast<float>(random.uniform(0, 60)),
                            static_cast<float>(random.uniform(0, 60)),
                            static_cast<float>(random.uniform(0, 10)));
    const VoxelKey key = voxelKey(p, 1);
    const auto [entry, is_new] = expected.emplace(key, expected.size());
    ASSERT_EQ(numbers.add(key), std::make_pair(entry->second, is_new));
  }
  EXPECT_EQ(numbers.size(), expected.size());
}
} // namespace
