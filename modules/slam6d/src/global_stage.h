// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "graph_stage.h"
#include "kept_scans.h"
#include "scan_matcher.h"

#include <pcl6d/common/progress.h>
#include <pcl6d/global_registration/scan_joiner.h>
#include <pcl6d/slam6d/slam6d_options.h>
#include <pcl6d/slam6d/slam6d_result.h>
#include <pcl6d/verification/verified_scan.h>

#include <cstddef>
#include <deque>
#include <functional>
#include <vector>

namespace pcl6d::slam6d {

/** \brief Makes a graph stage without scans; parameters are kept by reference. */
using StageMaker = std::function<GraphStage(const Slam6DParameters&)>;

/** \brief Scans without initial poses, in any order: joined into groups, each of which is
 * matched and relaxed by itself in the order in which its scans were joined, so that the
 * order of the scans does not matter. */
class GlobalStage {
public:
  /** All but make_stage are kept by reference.
   * \param[in] scans with all measured points where this process matches
   * \param[in] verified the same, as rays and surfaces
   * \param[in] make_stage copied */
  GlobalStage(const Slam6DOptions& options,
              const KeptScans& scans,
              const std::deque<VerifiedScan>& verified,
              const StageMaker& make_stage);

  /** \brief Registers all scans. Groups lie side by side: those beyond the first are
   * floating, scans that belong to none are predicted, with the reason. Those that an earlier
   * run has registered keep their places and are the first group; those of further runs are
   * moved in one piece into the world of the first.
   * \param[in] runs of each registered scan, which are the first ones, the number of its run
   * \param[in] report of progress; may throw, which ends it
   * \param[in,out] result not to be used if it ended so
   * \throws GroupsApart runs do not meet */
  void
  run(const std::vector<std::size_t>& runs,
      WorkSharing* sharing,
      const ProgressCallback& report,
      Slam6DResult& result) const;

private:
  JoinedScans
  join(const std::vector<std::size_t>& runs,
       const std::vector<ScanResult>& scans,
       const ProgressCallback& report) const;
  void
  match(const std::vector<std::size_t>& runs,
        const JoinedScans& joined,
        Slam6DResult& result) const;
  void
  matchBeginning(std::size_t scan, ScanMatcher& matcher, Slam6DResult& result) const;
  void
  relax(const JoinedScans& joined,
        const ProgressCallback& report,
        Slam6DResult& result) const;
  void
  layOut(const JoinedScans& joined, Slam6DResult& result) const;
  std::pair<double, double>
  extentOf(const std::vector<std::size_t>& group, const Slam6DResult& result) const;

  const Slam6DOptions& options_;
  const KeptScans& scans_;
  const std::deque<VerifiedScan>& verified_;
  StageMaker make_stage_;
};

} // namespace pcl6d::slam6d
