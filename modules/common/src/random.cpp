// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/random.h>

#include <cmath>

namespace pcl6d {

double
Random::normal()
{
  while (true) {
    const double u = uniform(-1, 1);
    const double v = uniform(-1, 1);
    const double q = u * u + v * v;
    if (q > 0 && q < 1)
      return u * std::sqrt(-2 * portableLog(q) / q);
  }
}

} // namespace pcl6d
