// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "any_order/joined_runs.h"
#include "graph/graph_stage.h"
#include "matching/kept_scans.h"
#include "matching/scan_matcher.h"
#include "recovery/recovery.h"

#include <pcl6d/common/progress.h>
#include <pcl6d/global_registration/scan_joiner.h>
#include <pcl6d/slam6d/slam6d_options.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace pcl6d::slam6d {

/** \brief Makes a graph stage without scans; parameters are kept by reference. */
using StageMaker = std::function<GraphStage(const Slam6DParameters&)>;

/** \brief Registration of scans without initial poses, in any order. Scans are joined into groups.
 * Each group is matched and relaxed separately, in the order in which its scans were joined: the
 * input order does not matter. */
class GlobalStage {
public:
  /** All arguments except make_stage are kept by reference.
   * \param[in] scans with all measured points in the process that matches
   * \param[in] recovery prepares the scans for place recognition
   * \param[in] make_stage copied */
  GlobalStage(const Slam6DOptions& options,
              const KeptScans& scans,
              Recovery& recovery,
              const StageMaker& make_stage);

  /** \brief Registers all scans. Groups are placed side by side: groups after the first are
   * floating, scans without a group are predicted, with the reason. Scans registered by an earlier
   * run keep their poses and form the first group. Further runs are each moved in one piece into
   * the world of the first run.
   * \param[in] runs number of the run of each registered scan; registered scans come first
   * \param[in] pieces poses of scans in pieces that stay in one piece; may be empty
   * \param[in] report of progress; may throw to end the stage
   * \param[in,out] result not to be used after report threw
   * \throws GroupsApart runs cannot be joined */
  void
  run(const std::vector<std::size_t>& runs,
      const KnownPlaces& pieces,
      WorkSharing* sharing,
      const ProgressCallback& report,
      Slam6DResult& result) const;

private:
  JoinedScans
  join(const std::vector<std::size_t>& runs,
       const KnownPlaces& pieces,
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
  Recovery& recovery_;
  StageMaker make_stage_;
};

} // namespace pcl6d::slam6d
