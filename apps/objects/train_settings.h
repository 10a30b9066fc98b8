// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/mesh_io.h>
#include <pcl6d/object_localization/cascade_training.h>
#include <pcl6d/object_localization/training_images.h>

namespace pcl6d::app {

/** \brief Settings of `train`. */
struct TrainSettings {
  std::vector<std::string> models;
  std::vector<std::string> backgrounds; ///< folders of scans, or scans
  std::string output;
  std::string state; ///< folder; empty until parse(): beside the output
  int every = 1;     ///< of the scans of a folder
  MeshOptions mesh;
  ScannerPreset scanner;
  DetectionViewOptions views; ///< pixel 0: chosen for the models
  TrainingImageOptions images;
  CascadeTrainingOptions training;
  bool quiet = false;
};

/** \return false after --help \throws UsageError */
bool
parseTrain(const std::vector<std::string>& arguments, TrainSettings& settings);

} // namespace pcl6d::app
