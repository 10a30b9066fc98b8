// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

namespace pcl6d::graph_relaxation {

/** \brief Reduces the weight of links that contradict the rest: w = (s / (r^2 + s))^2 after
 * Geman and McClure, with r the motion of its points that a link demands. s falls from twice
 * the largest r^2, where every link counts, to the square of the scale (graduated
 * non-convexity, GNC). s falls by half per round or faster, to end within the given number of
 * rounds. At the end, links up to 0.67 of the scale count fully, and only the excess enters w:
 * a quarter at the scale.
 *
 * To find the wrong links, every link needs equal weight, or the strongest link bends the map
 * before the test: the caller solves with equal weights until settled(). */
class LinkSwitch {
public:
  /** \param[in] scale [m]; 0: three times the robust standard deviation of the links
   * \param[in] least [m] lower bound of the scale, where links agree better; > 0
   * \param[in] rounds until s reaches the scale; > 0 */
  LinkSwitch(double scale, double least, int rounds)
  : scale_(scale), least_scale_(least), rounds_left_(rounds)
  {}

  /** \param[in] residuals r of each link [m]
   * \param[in] trusted links keep weight 1
   * \return the weights of the next round; 1 everywhere in the first round, so that residuals
   * are measured where the links agree best */
  std::vector<double>
  weights(const std::vector<double>& residuals, const std::vector<bool>& trusted);

  /** \return per link its agreement with the rest, 1 at r = 0: its weight without the range of
   * full weight */
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
