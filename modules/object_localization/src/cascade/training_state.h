// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/object_localization/cascade_training.h>

namespace pcl6d::object_localization {

/** \brief The finished stages of a training in a folder: `cascade.xml` and
 * `training.json`, with a fingerprint of the training's inputs. */
class TrainingState {
public:
  /** \param[in] folder empty: stages are not stored */
  TrainingState(std::filesystem::path folder,
                const std::vector<GrayImage>& positives,
                const std::vector<BackgroundImage>& backgrounds,
                const CascadeTrainingOptions& options);

  /** \brief Loads the stages stored by an earlier call, if any.
   * \throws IoFailed the state belongs to another training, or is broken */
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
