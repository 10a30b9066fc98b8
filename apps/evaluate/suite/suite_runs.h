// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/process/interrupt.h"
#include "common/progress_bar.h"
#include "evaluate/suite/run_record.h"
#include "evaluate/suite/suite_file.h"

#include <optional>
#include <set>

namespace pcl6d::app {

/** \brief A run of pcl_slam6d: a method on data. */
struct SuiteRun {
  std::size_t data;                ///< index in the suite
  std::size_t method;              ///< index in the suite
  int repetition;                  ///< from 1
  std::optional<RunRecord> record; ///< empty: no scans to run on
  std::string no_data;             ///< why there are none
};

/** \brief Names of the files and folders of a suite's results. */
struct SuiteFolder {
  std::filesystem::path folder;

  std::filesystem::path
  dataOf(const SuiteData& data) const
  {
    return folder / "data" / data.name;
  }
  /** \return the reference trajectory; may be empty */
  std::filesystem::path
  truthOf(const SuiteData& data) const
  {
    if (data.damage.changesFiles())
      return dataOf(data) / "groundtruth.txt";
    if (!data.scene.empty())
      return dataOf(data.undamaged()) / "groundtruth.txt";
    return data.reference;
  }
  std::filesystem::path
  runOf(const SuiteData& data, const SuiteMethod& method, int repetition) const
  {
    return folder / "runs" / data.name / method.name / std::to_string(repetition);
  }
};

/** \brief How to run a suite. */
struct SuiteRunOptions {
  int jobs = 1; ///< runs at once
  /** methods; data sets, by full name, by name without damage, or by name of the entry;
   * damages. Empty: run everything */
  std::set<std::string> only;
  std::optional<double> limit; ///< [s] instead of the suite's
};

/** \brief Runs the missing parts of a suite: simulations first, then every method on
 * every data set, each in a process of its own, with its result, log.txt and run.json
 * in a folder of its own. A finished run with equal programs, options and data is
 * reused. \return the requested runs, in the order of the suite; empty if interrupted
 * \throws IoFailed a file cannot be written */
std::optional<std::vector<SuiteRun>>
runSuite(const Suite& suite,
         const SuiteFolder& folder,
         const SuiteRunOptions& options,
         const Interrupt& interrupt,
         ProgressBar& bar);

} // namespace pcl6d::app
