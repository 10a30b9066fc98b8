// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/progress_bar.h"
#include "doctor/experiments.h"
#include "doctor/finding.h"
#include "doctor/measures.h"

#include <optional>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief A line of what to set. */
struct Advice {
  std::string what; ///< "setMaxCorrespondenceDistance(0.05)"
  std::string why;
};

/** \brief All that the reports tell. */
struct Diagnosis {
  DoctorPair pair;
  std::vector<Experiment> rows;
  /** places of the poses that are believed most: of all, of ours; none: there is none */
  std::optional<std::size_t> best, best_of_ours;
  Findings findings; ///< the worst first
  std::vector<Advice> advice;

  /** \return whether a pose of ours is verified */
  bool
  isVerified() const
  {
    return best_of_ours && rows[*best_of_ours].verdict.isGood();
  }
};

/** \brief Runs and checks everything.
 * \throws IoFailed, UsageError as loadPair() \throws Interrupted */
Diagnosis
diagnose(const DoctorSettings& settings, ProgressBar& bar, const Interrupt& interrupt);

/** \return what to set, by what was found */
std::vector<Advice>
adviceFor(const Diagnosis& diagnosis);

/** \return one sentence: what our result is worth */
std::string
conclusionOf(const Diagnosis& diagnosis);

} // namespace pcl6d::app
