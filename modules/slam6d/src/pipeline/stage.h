// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam_context.h"
#include "slam_state.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace pcl6d::slam6d {

/** \brief The end of a stage that was not cancelled. */
enum class StageEnd {
  kDone,
  kReverted, ///< the result got worse, and the previous result is kept
  kStopped   ///< no further stage is run; the partial result is kept
};

/** \brief A step of a run. It knows the state and the context, but no other stage. The pipeline
 * handles transaction, time, cancelling, result cache and exchange between processes. */
class Stage {
public:
  virtual ~Stage() = default;

  /** \return whether the stage has work to do; equal in each process */
  virtual bool
  isDue(const SlamState&) const
  {
    return true;
  }

  /** \return whether the stage matches scans one by one. Then only the first process runs the
   * stage, the rest take over its result, and its time counts as matching */
  virtual bool
  isMatching() const
  {
    return false;
  }

  /** \brief Called before key() and run(), to derive parameters that were unknown before. */
  virtual void
  prepare(SlamState&)
  {}

  /** \return a hash of all inputs of the stage; none: the result is not cached */
  virtual std::optional<std::uint64_t>
  key(const SlamState&) const
  {
    return std::nullopt;
  }

  /** \throws Cancelled with the result unchanged */
  virtual StageEnd
  run(SlamState& state, SlamContext& context) = 0;

  /** \brief Called in every process after the stage, also when its result was taken from a
   * cache. */
  virtual void
  finish(SlamState&, const SlamContext&)
  {}
};

/** \brief Stages in order. */
using StageList = std::vector<std::unique_ptr<Stage>>;

} // namespace pcl6d::slam6d
