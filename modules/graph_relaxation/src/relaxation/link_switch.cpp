// SPDX-License-Identifier: BSD-3-Clause
#include "relaxation/link_switch.h"

#include <pcl6d/common/median.h>

#include <algorithm>
#include <cstddef>

namespace pcl6d::graph_relaxation {

namespace {
// Three times the robust standard deviation (of normal residuals: 1.4826 medians).
constexpr double kScale = 3 * 1.4826;

/** Share of the scale up to which a link does not contradict the rest: three medians, rarely
 * exceeded by noise. */
constexpr double kFree = 3 / kScale;

constexpr double kSteady = 0.8; ///< the scale's square counts as steady from here

double
gemanMcClure(double residual_sq, double width_sq)
{
  const double root = width_sq / (residual_sq + width_sq);
  return root * root;
}
} // namespace

void
LinkSwitch::narrow(double wanted)
{
  const auto arrivesBy = [&](double step) {
    double width_sq = width_sq_;
    for (int round = 0; round < rounds_left_ && width_sq > wanted; ++round)
      width_sq *= step;
    return width_sq <= wanted;
  };
  double step = 0.5;
  rounds_left_ = std::max(1, rounds_left_);
  while (!arrivesBy(step))
    step *= 0.5;
  --rounds_left_;
  width_sq_ = std::max(wanted, step * width_sq_);
  // The scale falls, too, while scans converge or a wrong link loses its weight.
  const bool falls = wanted < kSteady * last_wanted_;
  settled_ = width_sq_ <= wanted && (!falls || rounds_left_ <= 0);
  last_wanted_ = wanted;
}

std::vector<double>
LinkSwitch::weights(const std::vector<double>& residuals,
                    const std::vector<bool>& trusted)
{
  std::vector<double> weights(residuals.size(), 1);
  agreement_ = weights;
  if (residuals.empty()) {
    settled_ = true;
    return weights;
  }
  if (!started_) {
    started_ = true;
    return weights;
  }
  const double scale =
      scale_ > 0 ? scale_ : std::max(kScale * upperMedian(residuals), least_scale_);
  if (width_sq_ == 0) {
    const double largest = *std::max_element(residuals.begin(), residuals.end());
    width_sq_ = 4 * largest * largest;
  }
  if (settled_)
    width_sq_ = scale * scale;
  else
    narrow(scale * scale);
  const double free_sq = settled_ ? kFree * kFree * width_sq_ : 0;
  for (std::size_t l = 0; l < residuals.size(); ++l)
    if (!trusted[l]) {
      const double r_sq = residuals[l] * residuals[l];
      weights[l] = gemanMcClure(std::max(0.0, r_sq - free_sq), width_sq_ - free_sq);
      agreement_[l] = gemanMcClure(r_sq, width_sq_);
    }
  return weights;
}

} // namespace pcl6d::graph_relaxation
