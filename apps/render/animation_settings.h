// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/process/memory_budget.h"

#include <cstddef>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief Kind of an animation. */
enum class AnimationKind {
  kFlyThrough, ///< the map, along the trajectory
  kTurntable,  ///< the map, once around
  kGrowth,     ///< scan after scan, in the order of matching
  kRelaxation  ///< from the initial to the final poses, stage by stage
};

/** \brief The command line of `animation`. */
struct AnimationSettings {
  std::string run;
  std::string output;
  AnimationKind kind = AnimationKind::kGrowth;
  int width = 1280;         ///< [px]
  int height = 720;         ///< [px]
  std::size_t frames = 200; ///< of kFlyThrough and kTurntable
  int steps = 8;            ///< frames from one round of kRelaxation to the next
  double fps = 0;           ///< [1/s] of the video
  std::size_t points = 1000000;
  bool force = false;
  MemoryOption memory;
  bool quiet = false;

  /** \return whether the output is one video file, else a folder */
  bool
  isVideo() const;
};

/** \return false: --help or --version was given, and the program is to end
 * \throws UsageError, boost::program_options::error the arguments break a rule */
bool
parseAnimationSettings(const std::vector<std::string>& arguments,
                       AnimationSettings& settings);

} // namespace pcl6d::app
