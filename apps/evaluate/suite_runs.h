// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/interrupt.h"
#include "common/progress_bar.h"
#include "evaluate/run_record.h"
#include "evaluate/suite_file.h"

#include <optional>
#include <set>

namespace pcl6d::app {

/** \brief A run of pcl_slam6d: a method on data. */
struct SuiteRun {
  std::size_t data;                ///< index in the suite
  std::size_t method;              ///< index in the suite
  int repetition;                  ///< from 1
  std::optional<RunRecord> record; ///< none: there are no scans to run on
  std::string no_data;             ///< why there are none
};

/** \brief Names and place of the files of a suite's results. */
struct SuiteFolder {
  std::filesystem::path folder;

  std::filesystem::path
  dataOf(const SuiteData& data) const
  {
    return folder / "data" / data.name;
  }
  /** \return the trajectory to compare with; empty if there is none */
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
  /** methods; data sets, by their full name, without damage, or that of their entry;
   * damages. Empty: all */
  std::set<std::string> only;
  std::optional<double> limit; ///< [s] instead of the suite's
};

/** \brief Runs what is not there yet: simulations first, then every method on every data
 * set, each in a process of its own, with its result, log.txt and run.json in a folder of
 * its own. A run that has ended before with the same programs, options and data is taken as
 * it is. \return all runs that were asked for, in the order of the suite; nothing if
 * interrupted \throws IoFailed a file cannot be written */
std::optional<std::vector<SuiteRun>>
runSuite(const Suite& suite,
         const SuiteFolder& folder,
         const SuiteRunOptions& options,
         const Interrupt& interrupt,
         ProgressBar& bar);

} // namespace pcl6d::app
