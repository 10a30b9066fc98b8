// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/random.h>
#include <pcl6d/graph_relaxation/block_system.h>

#include <Eigen/Core>

#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace pcl6d::test {

using Couplings = std::vector<std::pair<std::size_t, std::size_t>>;

/** Which blocks are coupled, in shapes that eliminate very differently. */
struct Shape {
  std::string name;
  std::size_t size;
  Couplings couplings;
};

inline void
PrintTo(const Shape& shape, std::ostream* stream)
{
  *stream << shape.name;
}

inline Couplings
chain(std::size_t size)
{
  Couplings couplings;
  for (std::size_t i = 0; i + 1 < size; ++i) // both orders
    couplings.emplace_back(i + i % 2, i + (i + 1) % 2);
  return couplings;
}

inline Couplings
grid(std::size_t side)
{
  Couplings couplings;
  for (std::size_t i = 0; i < side * side; ++i) {
    if (i % side + 1 < side)
      couplings.emplace_back(i, i + 1);
    if (i + side < side * side)
      couplings.emplace_back(i + side, i);
  }
  return couplings;
}

inline Couplings
randomPairs(std::size_t size, std::size_t count, std::uint64_t seed)
{
  pcl6d::Random random(seed);
  const auto pick = [&] {
    return static_cast<std::size_t>(random.uniform() * static_cast<double>(size));
  };
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  while (pairs.size() < count) {
    const std::size_t a = pick(), b = pick();
    if (a != b && pairs.count({b, a}) == 0)
      pairs.insert({a, b});
  }
  return {pairs.begin(), pairs.end()};
}

inline Couplings
star(std::size_t size)
{
  Couplings couplings;
  for (std::size_t i = 1; i < size; ++i)
    couplings.emplace_back(0, i);
  return couplings;
}

inline std::vector<Shape>
shapes()
{
  Couplings two_parts = chain(7);
  for (const auto& [a, b] : randomPairs(9, 20, 5))
    two_parts.emplace_back(a + 8, b + 8); // and block 7 alone
  return {{"One", 1, {}},
          {"Apart", 5, {}},
          {"Chain", 30, chain(30)},
          {"Star", 25, star(25)},
          {"Grid", 144, grid(12)},
          {"Parts", 17, two_parts},
          {"Dense", 12, randomPairs(12, 66, 1)},
          {"Random", 60, randomPairs(60, 150, 2)}};
}

/** A system and the same matrix dense. */
template <int Size>
struct Sample {
  explicit Sample(const Shape& shape, std::uint64_t seed = 3)
  : system(shape.size, shape.couplings)
  , dense(Eigen::MatrixXd::Zero(Size * shape.size, Size * shape.size))
  {
    pcl6d::Random random(seed);
    const auto draw = [&] { return random.uniform(-1, 1); };
    std::vector<double> degree(shape.size, 0);
    for (std::size_t k = 0; k < shape.couplings.size(); ++k) {
      const auto [a, b] = shape.couplings[k];
      auto& block = system.coupling(k);
      block = block.NullaryExpr(draw);
      dense.block<Size, Size>(Size * a, Size * b) = block;
      dense.block<Size, Size>(Size * b, Size * a) = block.transpose();
      ++degree[a];
      ++degree[b];
    }
    for (std::size_t i = 0; i < shape.size; ++i) { // diagonally dominant
      auto& block = system.diagonal(i);
      const typename BlockSystem<Size>::Block noise = block.NullaryExpr(draw);
      block = noise + noise.transpose();
      block.diagonal().array() += Size * (degree[i] + 2.5);
      dense.block<Size, Size>(Size * i, Size * i) = block;
    }
    for (std::size_t i = 0; i < shape.size; ++i)
      right.push_back(BlockSystem<Size>::Vector::NullaryExpr(draw));
  }

  Eigen::VectorXd
  stacked(const std::vector<typename BlockSystem<Size>::Vector>& blocks) const
  {
    Eigen::VectorXd x(Size * blocks.size());
    for (std::size_t i = 0; i < blocks.size(); ++i)
      x.segment<Size>(Size * i) = blocks[i];
    return x;
  }

  BlockSystem<Size> system;
  Eigen::MatrixXd dense;
  std::vector<typename BlockSystem<Size>::Vector> right;
};

} // namespace pcl6d::test
