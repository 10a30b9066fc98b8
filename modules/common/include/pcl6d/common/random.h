// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cstdint>
#include <random>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Seeded random numbers, equal for every standard library and CPU: the distributions of
 * the standard differ and are therefore implemented here.
 * \ingroup common */
class Random {
public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /** \return a number in [0, 1) with 53 random bits */
  double
  uniform()
  {
    return static_cast<double>(engine_() >> 11) * 0x1.0p-53;
  }

  /** \return a number in [low, high) */
  double
  uniform(double low, double high)
  {
    return low + (high - low) * uniform();
  }

  /** \return a standard normal number (polar method, Marsaglia and Bray 1964) */
  double
  normal();

private:
  std::mt19937_64 engine_;
};

/** \brief Mixes the bits of a key (the finaliser of splitmix64, Steele et al. 2014), for random
 * choices that depend on the key and not on the order of the work. */
inline std::uint64_t
mixBits(std::uint64_t key)
{
  key += 0x9e3779b97f4a7c15ull;
  key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9ull;
  key = (key ^ (key >> 27)) * 0x94d049bb133111ebull;
  return key ^ (key >> 31);
}

} // namespace pcl6d
