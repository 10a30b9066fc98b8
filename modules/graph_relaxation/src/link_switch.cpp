// SPDX-License-Identifier: BSD-3-Clause
#include "link_switch.h"

#include <algorithm>
#include <cstddef>

namespace pcl6d {

namespace {
constexpr double kLeastScale = 1e-3; // [m] links that agree better are all true

double
scaleOf(std::vector<double> residuals)
{
  const auto middle =
      residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  return std::max(3 * 1.4826 * *middle, kLeastScale);
}
} // namespace

std::vector<double>
LinkSwitch::weights(const std::vector<double>& residuals,
                    const std::vector<bool>& trusted)
{
  std::vector<double> weights(residuals.size(), 1);
  if (residuals.empty()) {
    settled_ = true;
    return weights;
  }
  if (!started_) {
    started_ = true;
    return weights;
  }
  const double scale = scale_ > 0 ? scale_ : scaleOf(residuals);
  if (width_sq_ == 0) {
    const double largest = *std::max_element(residuals.begin(), residuals.end());
    width_sq_ = 4 * largest * largest;
  }
  width_sq_ = std::max(scale * scale, width_sq_ / 2);
  settled_ = width_sq_ <= scale * scale;
  for (std::size_t l = 0; l < residuals.size(); ++l)
    if (!trusted[l]) {
      const double root = width_sq_ / (residuals[l] * residuals[l] + width_sq_);
      weights[l] = root * root;
    }
  return weights;
}

} // namespace pcl6d
