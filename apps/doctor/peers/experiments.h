// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/progress_bar.h"
#include "doctor/measures.h"
#include "doctor/peers/class_run.h"

#include <optional>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief Variant of the input of a class, to see changes of the result. */
struct InputVariant {
  /** relative to the offsets, subtracted in double before rounding to float */
  bool local = false;
  bool without_nan = false; ///< rows of NaN are taken out
  bool extracted = false;   ///< only the points of the indices, in place of the indices
  bool without_indices = false; ///< all points
  bool own_normals = false;     ///< estimated normals in place of the file's
};

/** \brief Assessment of a pose by RegistrationVerifier. */
struct PoseVerdict {
  std::string trust; ///< "good", "unverified", "weak", "wrong"; empty: not tested
  double probability_wrong = 1;
  std::size_t patches = 0, contradicted = 0;
  std::string reason; ///< in words; for an untested pose: the cause
  PoseFit fit;        ///< within the distance of the pair

  bool
  isGood() const
  {
    return trust == "good";
  }
};

/** \brief A row of the table of classes. Poses of outcomes are local. */
struct Experiment {
  RegistrationClass method = RegistrationClass::kPclIcp;
  ClassSettings settings;
  InputVariant input;        ///< of the outcome; probes change one more setting
  std::string setting_words; ///< for the table, e.g. "max distance 0.1 m"
  std::string start_words;   ///< empty: the start of the pair
  Eigen::Isometry3d start = Eigen::Isometry3d::Identity(); ///< local
  ClassOutcome outcome;
  PoseVerdict verdict;
  /** Repetitions with one change each; empty: not needed. */
  std::optional<ClassOutcome> longer, local, without_nan, extracted, whole, own_normals;

  std::string
  name() const
  {
    return std::string(toString(method)) + ", " + setting_words;
  }
};

/** \brief Runs the classes from the start of the pair, and again with each variant that
 * may change their results. \throws Interrupted */
std::vector<Experiment>
runExperiments(const DoctorPair& pair,
               double time_limit,
               ProgressBar& bar,
               const Interrupt& interrupt);

/** \brief Runs our classes from the starts found by coarse alignment.
 * \throws Interrupted */
std::vector<Experiment>
runCoarseStarts(const DoctorPair& pair,
                double time_limit,
                ProgressBar& bar,
                const Interrupt& interrupt);

/** \brief Tests the pose of every experiment by RegistrationVerifier.
 * \throws Interrupted */
void
evaluate(const DoctorPair& pair,
         double time_limit,
         std::vector<Experiment>& experiments,
         const Interrupt& interrupt);

/** \return the index of the experiment with the most reliable pose: by verdict, then by
 * fit, then ours before PCL's; empty without a pose */
std::optional<std::size_t>
bestOf(const DoctorPair& pair,
       const std::vector<Experiment>& experiments,
       bool only_ours);

} // namespace pcl6d::app
