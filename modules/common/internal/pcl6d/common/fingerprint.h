// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>

#include <Eigen/Geometry>

#include <cstdint>
#include <cstring>

namespace pcl6d {

/** \brief A hash that distinguishes data to the last bit: FNV-1a over words. Equal on all
 * machines of one byte order; no protection against malice. \ingroup common */
class Fingerprint {
public:
  void
  add(std::uint32_t word)
  {
    sum_ = (sum_ ^ word) * 1099511628211U;
  }
  void
  add(std::uint64_t word)
  {
    add(static_cast<std::uint32_t>(word));
    add(static_cast<std::uint32_t>(word >> 32));
  }
  void
  add(float value)
  {
    std::uint32_t word = 0;
    std::memcpy(&word, &value, sizeof word);
    add(word);
  }
  void
  add(double value)
  {
    std::uint64_t word = 0;
    std::memcpy(&word, &value, sizeof word);
    add(word);
  }
  void
  add(const Points& points)
  {
    for (const auto& p : points)
      for (int axis = 0; axis < 3; ++axis)
        add(p[axis]);
  }
  void
  add(const Eigen::Isometry3d& pose)
  {
    for (int i = 0; i < 16; ++i)
      add(pose.data()[i]);
  }

  std::uint64_t
  value() const
  {
    return sum_;
  }

private:
  std::uint64_t sum_ = 14695981039346656037U;
};

/** \return the fingerprint of a scan's points */
inline std::uint64_t
fingerprintOf(const Points& points)
{
  Fingerprint sum;
  sum.add(points);
  return sum.value();
}

} // namespace pcl6d
