// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

namespace pcl6d::graph_relaxation {

/** \brief Takes the weight from links that contradict the others: w = (s / (r^2 + s))^2
 * after Geman and McClure, r being how far a link wants to move its points. s falls from
 * twice the largest r^2, where all links count, to the square of the scale (graduated
 * non-convexity, GNC), by half per round or faster, so that it arrives in the given
 * number of rounds. Then links up to 0.67 of the scale count fully, and only what
 * exceeds that enters w; at the scale it is still a quarter.
 *
 * To find the false links all must have the same say, or the strongest one bends the map
 * before it is found out: the caller solves for links that are alike until settled(). */
class LinkSwitch {
public:
  /** \param[in] scale [m]; 0: three times the robust standard deviation of the links
   * \param[in] least [m] scale that links which agree better are held to; > 0
   * \param[in] rounds in which s comes down; > 0 */
  LinkSwitch(double scale, double least, int rounds)
  : scale_(scale), least_scale_(least), rounds_left_(rounds)
  {}

  /** \param[in] residuals r of each link [m] \param[in] trusted links keep weight 1
   * \return the weights of the next round; 1 for all in the first one, so that what the
   * links want is measured where they agree best */
  std::vector<double>
  weights(const std::vector<double>& residuals, const std::vector<bool>& trusted);

  /** \return per link how well it agrees with the others, 1 at r = 0: its weight without
   * the part of the scale in which links count fully */
  const std::vector<double>&
  agreement() const
  {
    return agreement_;
  }

  /** \return whether s has come down to the scale */
  bool
  settled() const
  {
    return settled_;
  }

private:
  void
  narrow(double wanted);

  double scale_;
  double least_scale_;
  std::vector<double> agreement_;
  int rounds_left_;
  bool started_ = false;
  bool settled_ = false;
  double width_sq_ = 0; ///< s [m^2]; 0: not known yet
  /** Square of the scale a round ago [m^2]. */
  double last_wanted_ = std::numeric_limits<double>::infinity();
};

} // namespace pcl6d::graph_relaxation
