// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "graph_stage.h"

#include <deque>
#include <optional>

namespace pcl6d::slam6d {

/** \brief Closes loops while scans are still matched: a loop that a scan closes is closed
 * before the next one is matched (Slam6DOptions::close_loops_online). */
class OnlineLoops {
public:
  bool
  isBegun() const
  {
    return stage_.has_value();
  }

  /** \param[in] stage without scans */
  void
  begin(GraphStage stage)
  {
    stage_.emplace(std::move(stage));
  }

  /** \brief Looks for a loop that a scan closes. Changes the poses of the result, and derives
   * its parameters of loops from the scans that are matched.
   * \param[in] models of all scans, kept by reference \param[in] scan the last that is matched
   * \return whether poses have changed */
  bool
  close(const std::deque<IcpModel>& models,
        std::size_t scan,
        const Slam6DOptions& options,
        Slam6DResult& result);

  /** \brief All scans are matched. What was closed stays known. */
  void
  end()
  {
    stage_.reset();
  }

  const ClosedLoops&
  closed() const
  {
    return closed_;
  }

private:
  std::optional<GraphStage> stage_;
  ClosedLoops closed_;
  std::size_t last_closed_ = 0; ///< scan that closed a loop
};

} // namespace pcl6d::slam6d
