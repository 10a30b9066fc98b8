// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/object_localization/cascade_training.h>

namespace pcl6d::object_localization {

/** \brief The stages that a training has finished, in a folder: `cascade.xml` and
 * `training.json`, with what tells this training from others. */
class TrainingState {
public:
  /** \param[in] folder empty: nothing is kept */
  TrainingState(std::filesystem::path folder,
                const std::vector<GrayImage>& positives,
                const std::vector<BackgroundImage>& backgrounds,
                const CascadeTrainingOptions& options);

  /** \brief Takes what an earlier call left; nothing if there is nothing.
   * \throws IoFailed it belongs to another training, or is broken */
  void
  load(CascadeTraining& training) const;

  /** \throws IoFailed the folder cannot be made or written */
  void
  save(const CascadeTraining& training) const;

private:
  std::filesystem::path folder_;
  std::string fingerprint_;
};

} // namespace pcl6d::object_localization
