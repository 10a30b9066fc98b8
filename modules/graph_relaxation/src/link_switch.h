// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace pcl6d {

/** \brief Takes the weight from links that contradict the others: w = (s / (r^2 + s))^2
 * after Geman and McClure, r being how far a link wants to move its points. s falls from
 * twice the largest r^2, where all links count, by half per round to the square of the
 * scale (graduated non-convexity, GNC). */
class LinkSwitch {
public:
  /** \param[in] scale [m]; 0: three times the robust standard deviation of the links */
  explicit LinkSwitch(double scale) : scale_(scale) {}

  /** \param[in] residuals r of each link [m] \param[in] trusted links keep weight 1
   * \return the weights of the next round; 1 for all in the first one, so that what the
   * links want is measured where they agree best */
  std::vector<double>
  weights(const std::vector<double>& residuals, const std::vector<bool>& trusted);

  /** \return whether s has come down to the scale */
  bool
  settled() const
  {
    return settled_;
  }

private:
  double scale_;
  bool started_ = false;
  bool settled_ = false;
  double width_sq_ = 0; ///< s [m^2]; 0: not known yet
};

} // namespace pcl6d
