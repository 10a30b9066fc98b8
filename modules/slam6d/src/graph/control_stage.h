// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/slam6d/slam6d_options.h>
#include <pcl6d/slam6d/slam6d_result.h>

namespace pcl6d::slam6d {

/** \brief The adjustment of a registered map to control points: the last stage of a run. */
class ControlStage {
public:
  ControlStage(const ControlOptions& options, unsigned int num_threads);

  /** \brief Fills Slam6DResult::control. \param[in,out] result with its verification, whose links
   * are the measured relative poses. If the points fit, all poses except the initial ones change
   * to the frame of the control points, and a stage is added.
   * \param[in] least_factor least variance factor of the links, see linksOfMap()
   * \return whether a link moved by more than its standard deviation, which requires another
   * verification of the map */
  bool
  adjust(double least_factor, Slam6DResult& result);

  /** \brief Gives the scans their covariances in the frame of the control points. */
  void
  takeCovariances(Slam6DResult& result) const;

private:
  ControlOptions options_;
  ControlAdjustment adjusted_;
};

} // namespace pcl6d::slam6d
