// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/benchmarking/trust_table.h>
#include <pcl6d/common/run_result.h>
#include <pcl6d/verification/ties.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pcl6d::bench {

/** \brief A finished run with ground truth. */
struct CutRun {
  std::string name;   ///< of the data, with the damage and the method
  std::string sensor; ///< scanner of the simulator
  RunResult result;   ///< with its verdict
  /** Links of the verdict as they were before parts were cut off, by the positions of their scans
   * in the result. Links of unregistered scans are weak. */
  std::vector<LinkCheck> links;
  std::vector<Eigen::Isometry3d> truth; ///< T_world_scan of every scan in the folder
  std::optional<std::size_t> foreign;   ///< index of a scan of another scene
};

/** \brief Reads the finished runs of `pcl_slam6d_evaluate suite` over simulated data. Runs without
 * a map are skipped. \param[in] results folder of the suite's results
 * \throws IoFailed a file is missing or broken */
std::vector<CutRun>
readSuiteRuns(const std::filesystem::path& results);

/** \brief Reads one run. \param[in] run output folder of `pcl_slam6d`
 * \param[in] data folder of the simulated scans \throws IoFailed a file is missing or broken */
CutRun
readCutRun(const std::filesystem::path& run, const std::filesystem::path& data);

/** \return the links before cuts: a link that was cut together with others was good
 * \param[in] links of verification.csv, by the indices of the scans */
std::vector<LinkCheck>
linksBeforeCuts(std::vector<LinkCheck> links, const std::vector<ScanResult>& scans);

/** \brief The verdict of a run with given constants, beside the truth. */
struct CutVerdict {
  /** The verdict on the map. Beside the cuts, recorded doubts count, and wrong links between scans
   * that the given constants connect. */
  TrustRun map;
  bool is_misplaced = false; ///< consistent links join scans at a wrong relative pose
  bool is_missed = false;    ///< such a link is left between connected scans
  bool is_right_cut =
      false; ///< a consistent link at a right relative pose is cut, in a map
             ///< without such links at a wrong one
};

/** \return the verdict with other constants at the recorded poses */
CutVerdict
verdictWith(const verification::CutConstants& constants, const CutRun& run);

/** \return the verdict as the run recorded it, beside the truth */
TrustRun
recordedVerdict(const CutRun& run);

} // namespace pcl6d::bench
