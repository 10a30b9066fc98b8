// SPDX-License-Identifier: BSD-3-Clause
#include "sparse/supernodal_cholesky.h"

#include <pcl6d/common/error.h>
#include <pcl6d/graph_relaxation/block_system.h>

#include <algorithm>
#include <string>

namespace pcl6d {
using namespace graph_relaxation;

namespace {
using Couplings = std::vector<std::pair<std::size_t, std::size_t>>;

std::string
shown(const Couplings::value_type& coupling)
{
  return "coupling (" + std::to_string(coupling.first) + ", " +
         std::to_string(coupling.second) + ")";
}

void
check(std::size_t num_blocks, const Couplings& couplings)
{
  Couplings sorted = couplings;
  for (auto& coupling : sorted) {
    if (coupling.first >= num_blocks || coupling.second >= num_blocks)
      throw BadArgument(shown(coupling) + ", but there are only " +
                        std::to_string(num_blocks) + " blocks");
    if (coupling.first == coupling.second)
      throw BadArgument(shown(coupling) + ", but a block is not coupled with itself");
    if (coupling.first > coupling.second)
      std::swap(coupling.first, coupling.second);
  }
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end())
    throw BadArgument(shown(*twice) + " is given twice");
}
} // namespace

template <int Size>
struct BlockSystem<Size>::Impl {
  Impl(std::size_t num_blocks, const Couplings& pairs)
  : cholesky(num_blocks, pairs, Size)
  , diagonals(num_blocks, Block::Zero())
  , couplings(pairs.size(), Block::Zero())
  {
    static_assert(sizeof(Block) == Size * Size * sizeof(double), "blocks are packed");
  }

  void
  requireFactor() const
  {
    if (!cholesky.hasFactor())
      throw ComputeFailed("the system has no factor: factorize() was not called, or "
                          "the matrix is not positive definite");
  }

  SupernodalCholesky cholesky;
  std::vector<Block> diagonals;
  std::vector<Block> couplings;
};

template <int Size>
BlockSystem<Size>::BlockSystem(std::size_t num_blocks, const Couplings& couplings)
{
  check(num_blocks, couplings);
  impl_ = std::make_unique<Impl>(num_blocks, couplings);
}

template <int Size>
BlockSystem<Size>::~BlockSystem() = default;

template <int Size>
BlockSystem<Size>::BlockSystem(BlockSystem&&) noexcept = default;

template <int Size>
BlockSystem<Size>&
BlockSystem<Size>::operator=(BlockSystem&&) noexcept = default;

template <int Size>
void
BlockSystem<Size>::setZero()
{
  std::fill(impl_->diagonals.begin(), impl_->diagonals.end(), Block::Zero());
  std::fill(impl_->couplings.begin(), impl_->couplings.end(), Block::Zero());
}

template <int Size>
typename BlockSystem<Size>::Block&
BlockSystem<Size>::diagonal(std::size_t i)
{
  return impl_->diagonals[i];
}

template <int Size>
typename BlockSystem<Size>::Block&
BlockSystem<Size>::coupling(std::size_t k)
{
  return impl_->couplings[k];
}

template <int Size>
bool
BlockSystem<Size>::factorize(double damping, unsigned int num_threads)
{
  return impl_->cholesky.factorize(
      reinterpret_cast<const double*>(impl_->diagonals.data()),
      reinterpret_cast<const double*>(impl_->couplings.data()),
      damping,
      num_threads);
}

template <int Size>
std::vector<typename BlockSystem<Size>::Vector>
BlockSystem<Size>::solve(const std::vector<Vector>& b) const
{
  impl_->requireFactor();
  if (b.size() != impl_->diagonals.size())
    throw BadArgument("the right-hand side has " + std::to_string(b.size()) +
                      " blocks, but the system " +
                      std::to_string(impl_->diagonals.size()));
  std::vector<Vector> x = b;
  impl_->cholesky.solve(reinterpret_cast<double*>(x.data()));
  return x;
}

template <int Size>
std::vector<typename BlockSystem<Size>::Block>
BlockSystem<Size>::inverseDiagonals() const
{
  impl_->requireFactor();
  std::vector<Block> blocks(impl_->diagonals.size());
  impl_->cholesky.inverseDiagonals(reinterpret_cast<double*>(blocks.data()));
  return blocks;
}

template class BlockSystem<1>;
template class BlockSystem<3>;
template class BlockSystem<6>;
template class BlockSystem<7>;

} // namespace pcl6d
