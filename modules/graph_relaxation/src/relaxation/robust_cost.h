// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/portable_math.h>
#include <pcl6d/registration/icp_options.h>

#include <cmath>

namespace pcl6d::graph_relaxation {

/** \brief rho(s) of a link's squared error s, and its slope, the link's weight.
 * Internal to the module graph_relaxation. */
struct RobustCost {
  RobustKernel kernel = RobustKernel::kNone;
  double width_sq = 1; ///< of the s at which the kernel sets in

  double
  cost(double s) const
  {
    switch (kernel) {
    case RobustKernel::kHuber:
      return s <= width_sq ? s : 2 * std::sqrt(width_sq * s) - width_sq;
    case RobustKernel::kCauchy:
      return width_sq * portableLog(1 + s / width_sq);
    case RobustKernel::kGemanMcClure:
      return s * width_sq / (s + width_sq);
    case RobustKernel::kNone:
      break;
    }
    return s;
  }

  double
  weight(double s) const
  {
    const double share = width_sq / (s + width_sq);
    switch (kernel) {
    case RobustKernel::kHuber:
      return s <= width_sq ? 1 : std::sqrt(width_sq / s);
    case RobustKernel::kCauchy:
      return share;
    case RobustKernel::kGemanMcClure:
      return share * share;
    case RobustKernel::kNone:
      break;
    }
    return 1;
  }
};

} // namespace pcl6d::graph_relaxation
