// SPDX-License-Identifier: BSD-3-Clause
// The order of file names: numbers by their value, times with decimals, versions, text.
#include <pcl6d/io/natural_order.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace pcl6d {
namespace {
using Names = std::vector<std::string>;

/** \return the names, brought into some order first and sorted then */
Names
sorted(Names names, unsigned int seed)
{
  std::mt19937 random(seed);
  std::shuffle(names.begin(), names.end(), random);
  std::sort(names.begin(), names.end(), naturalLess);
  return names;
}

TEST(NaturalOrder, SortsByNumbers)
{
  const std::vector<Names> orders = {
      {"scan2.pcd", "scan010.pcd", "scan10.pcd", "scan11.pcd"},
      {"0.0.pcd", "0.05.pcd", "0.1.pcd", "0.15.pcd", "0.2.pcd", "1.0.pcd", "10.5.pcd"},
      {"1657900000.0.bin",
       "1657900000.05.bin",
       "1657900000.1.bin",
       "1657900001.05.bin"},
      {"cloud_1657900000.05.ply", "cloud_1657900000.1.ply"},
      {"run1.2.pcd", "run1.10.pcd"},                         // no time, so no decimals
      {"1.2.3.pcd", "1.2.10.pcd", "1.10.1.pcd"},             // versions
      {"2024.01.05.pcd", "2024.01.15.pcd", "2024.1.20.pcd"}, // dates
      {"2026-11-28T08.pcd", "2026-11-28T09.pcd", "2026-12-01T01.pcd"},
      {"9.3d", "10.3d", "11.3d"},
      {"0.5.pcd", "0.50.pcd"}};
  for (const Names& order : orders)
    for (unsigned int seed = 0; seed < 5; ++seed)
      EXPECT_EQ(sorted(order, seed), order) << order.front();
}

TEST(NaturalOrder, IsAnOrder)
{
  // Irreflexive, antisymmetric, transitive, and total on different names.
  const std::vector<std::string> parts = {
      "", "0", "1", "05", "10", ".", ".0", ".5", "a"};
  Names names;
  for (const std::string& a : parts)
    for (const std::string& b : parts)
      for (const std::string& c : parts)
        names.push_back(a + b + c);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  const Names order = sorted(names, 1);
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = 0; k < order.size(); ++k)
      ASSERT_EQ(naturalLess(order[i], order[k]), i < k) << order[i] << ' ' << order[k];
}

} // namespace
} // namespace pcl6d
