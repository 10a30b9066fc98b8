// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/progress_bar.h"
#include "doctor/finding.h"
#include "doctor/measures.h"
#include "doctor/peers/experiments.h"

#include <optional>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief A recommended setting. */
struct Advice {
  std::string what; ///< "setMaxCorrespondenceDistance(0.05)"
  std::string why;
};

/** \brief Content of the reports. */
struct Diagnosis {
  DoctorPair pair;
  std::vector<Experiment> rows;
  /** indices of the most reliable poses: over every class, and over our classes; empty:
   * no pose */
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

/** \brief Runs the experiments and checks.
 * \throws IoFailed, UsageError as loadPair() \throws Interrupted */
Diagnosis
diagnose(const DoctorSettings& settings, ProgressBar& bar, const Interrupt& interrupt);

/** \return recommended settings, from the findings */
std::vector<Advice>
adviceFor(const Diagnosis& diagnosis);

/** \return one sentence on the reliability of our result */
std::string
conclusionOf(const Diagnosis& diagnosis);

} // namespace pcl6d::app
