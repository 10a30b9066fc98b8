// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/common/progress.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A user's stage in a run of Slam6D: a loop detector, a check, an alternative relaxation
 * (Slam6D::addStage()). \ingroup slam6d */
class SlamStage {
public:
  /** \brief The position of the stage in the run. */
  enum class Place {
    kAfterMatching, ///< before loops are closed and poses relaxed; not in any order (kGlobal)
    kAfterRelaxation ///< before the map is verified
  };

  /** \brief The decision of a stage. */
  struct Report {
    bool accepted = true; ///< false: poses and links are reset to their state before
                          ///< the stage
    /** pairs to be linked by the relaxation, like Slam6DOptions::given_links; only used after
     * matching, and required anew in each optimize() */
    std::vector<ScanPair> links;
  };

  virtual ~SlamStage() = default;

  /** \return a name for progress and messages */
  virtual std::string
  name() const = 0;

  /** \brief Runs on all added scans; called once in each Slam6D::optimize().
   * \param[in] scans reduced points of each scan [m], in its own frame
   * \param[in,out] result of the stages before: T_world_scan of the scans may be changed
   * \param[in] report may be called with the progress of the stage; throws when the run is
   * cancelled, and this exception must not be caught */
  virtual Report
  run(const std::vector<const Points*>& scans,
      Slam6DResult& result,
      const ProgressCallback& report) = 0;
};

} // namespace pcl6d
