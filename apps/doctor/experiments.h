// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/progress_bar.h"
#include "doctor/class_run.h"
#include "doctor/measures.h"

#include <optional>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief Another way of giving a class the same clouds, to see what changes. */
struct InputVariant {
  bool local = false;       ///< less the offsets, in double before they are float
  bool without_nan = false; ///< rows of NaN are taken out
  bool extracted = false;   ///< only the points of the indices, in place of the indices
  bool without_indices = false; ///< all points
  bool own_normals = false;     ///< estimated ones in place of those of the file
};

/** \brief What is to be made of a pose; by RegistrationVerifier. */
struct PoseVerdict {
  std::string trust; ///< "good", "unverified", "weak", "wrong"; empty: not judged
  double probability_wrong = 1;
  std::size_t patches = 0, contradicted = 0;
  std::string reason; ///< in words; of one not judged: why
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
  InputVariant input;        ///< of the outcome; its probes change one thing more
  std::string setting_words; ///< "as it is", "max distance 0.1 m"
  std::string start_words;   ///< empty: the start of the pair
  Eigen::Isometry3d start = Eigen::Isometry3d::Identity(); ///< local
  ClassOutcome outcome;
  PoseVerdict verdict;
  /** The same once more, with one thing changed; none: there was no reason to. */
  std::optional<ClassOutcome> longer, local, without_nan, extracted, whole, own_normals;

  std::string
  name() const
  {
    return std::string(toString(method)) + ", " + setting_words;
  }
};

/** \brief Runs the classes from the start of the pair, and once more each for what may change
 * their results. \throws Interrupted */
std::vector<Experiment>
runExperiments(const DoctorPair& pair,
               double time_limit,
               ProgressBar& bar,
               const Interrupt& interrupt);

/** \brief Ours from the starts of coarse alignment that finds any. \throws Interrupted */
std::vector<Experiment>
runCoarseStarts(const DoctorPair& pair,
                double time_limit,
                ProgressBar& bar,
                const Interrupt& interrupt);

/** \brief Asks RegistrationVerifier about the poses of all experiments. \throws Interrupted */
void
judge(const DoctorPair& pair,
      double time_limit,
      std::vector<Experiment>& experiments,
      const Interrupt& interrupt);

/** \return the place of the experiment whose pose is to be believed most: by its verdict,
 * then by the fit, then ours before PCL's; none if there is no pose */
std::optional<std::size_t>
bestOf(const DoctorPair& pair,
       const std::vector<Experiment>& experiments,
       bool only_ours);

} // namespace pcl6d::app
