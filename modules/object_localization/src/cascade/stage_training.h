// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/object_localization/cascade_training.h>

namespace pcl6d::object_localization {

/** \brief A trained stage with its own list of features. */
struct TrainedStage {
  HaarStage stage; ///< its nodes index `features`
  std::vector<HaarFeature> features;
  StageReport report;
  bool reached = false; ///< max_false_alarm
};

/** \return indices drawn by the seed from [0, size), ascending */
std::vector<std::size_t>
drawn(std::size_t size, std::size_t count, std::uint64_t seed);

/** \param[in] features candidates of the stage
 * \param[in] seed of the draw of features for each tree \throws BadArgument too many
 * windows */
TrainedStage
trainStage(const std::vector<GrayImage>& positives,
           const std::vector<GrayImage>& negatives,
           const std::vector<HaarFeature>& features,
           const CascadeTrainingOptions& options,
           std::uint64_t seed);

/** \brief Appends a stage and the features of its nodes that are new to the cascade. */
void
append(HaarCascade& cascade, const TrainedStage& trained);

} // namespace pcl6d::object_localization
