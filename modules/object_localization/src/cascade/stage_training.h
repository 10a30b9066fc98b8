// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/object_localization/cascade_training.h>

namespace pcl6d::object_localization {

/** \brief A stage as it was trained, apart from its cascade. */
struct TrainedStage {
  HaarStage stage; ///< its nodes name places in `features`
  std::vector<HaarFeature> features;
  StageReport report;
  bool reached = false; ///< max_false_alarm
};

/** \return some of the places [0, size), drawn by the seed, in order */
std::vector<std::size_t>
drawn(std::size_t size, std::size_t count, std::uint64_t seed);

/** \param[in] features that the stage may use
 * \param[in] seed of which each of its trees may use \throws BadArgument too many windows */
TrainedStage
trainStage(const std::vector<GrayImage>& positives,
           const std::vector<GrayImage>& negatives,
           const std::vector<HaarFeature>& features,
           const CascadeTrainingOptions& options,
           std::uint64_t seed);

/** \brief Appends a stage and those of its features that it uses and the cascade does not
 * have yet. */
void
append(HaarCascade& cascade, const TrainedStage& trained);

} // namespace pcl6d::object_localization
