// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/search/leaf_memory.h>

#include <algorithm>

namespace pcl6d {

namespace {
constexpr std::uint64_t kLeafBits = 0xffffffffu;

/** \return the number of a point of a size at an address: consecutive in an array */
std::uint64_t
numberOf(const void* address, std::size_t size)
{
  return reinterpret_cast<std::uintptr_t>(address) / size;
}

std::size_t
powerOfTwoFrom(std::size_t least)
{
  std::size_t power = 1;
  while (power < least)
    power *= 2;
  return power;
}
} // namespace

LeafMemory::LeafMemory(std::size_t queries)
: places_(powerOfTwoFrom(queries)), entries_(new std::atomic<std::uint64_t>[places_])
{
  std::for_each(entries_.get(), entries_.get() + places_, [](auto& entry) {
    entry.store(0, std::memory_order_relaxed);
  });
}

int
LeafMemory::leafOf(const void* address, std::size_t size) const
{
  const std::uint64_t number = numberOf(address, size);
  const std::uint64_t entry =
      entries_[number % places_].load(std::memory_order_relaxed);
  const bool is_same = entry >> 32 == (number / places_ & kLeafBits);
  return is_same ? static_cast<int>(entry & kLeafBits) - 1 : -1;
}

void
LeafMemory::remember(const void* address, std::size_t size, int leaf)
{
  const std::uint64_t number = numberOf(address, size);
  entries_[number % places_].store(number / places_ << 32 |
                                       static_cast<std::uint32_t>(leaf + 1),
                                   std::memory_order_relaxed);
}

std::size_t
LeafMemory::count() const
{
  return std::count_if(entries_.get(), entries_.get() + places_, [](const auto& entry) {
    return (entry.load(std::memory_order_relaxed) & kLeafBits) != 0;
  });
}

} // namespace pcl6d
