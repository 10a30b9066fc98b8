// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "graph/graph_stage.h"

#include <deque>
#include <optional>

namespace pcl6d::slam6d {

/** \brief Closes loops during matching: each loop is closed before the next scan is matched
 * (Slam6DOptions::close_loops_online). */
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

  /** \brief Detects and closes a loop that ends at a scan. Changes the poses of the result, and
   * derives the loop parameters from the matched scans.
   * \param[in] models of all scans, kept by reference \param[in] scan the latest matched scan
   * \return whether poses have changed */
  bool
  close(const std::deque<IcpModel>& models,
        std::size_t scan,
        const Slam6DOptions& options,
        Slam6DResult& result);

  /** \brief Ends matching. The closed loops are kept. */
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
  std::size_t last_closed_ = 0; ///< latest scan with a closed loop
};

} // namespace pcl6d::slam6d
