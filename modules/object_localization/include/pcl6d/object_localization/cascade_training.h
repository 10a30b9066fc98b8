// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/progress.h>
#include <pcl6d/object_localization/haar_cascade.h>
#include <pcl6d/object_localization/window_gate.h>

#include <filesystem>
#include <functional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of trainCascade(). */
struct CascadeTrainingOptions {
  int width = 24;  ///< [px] of the window, in [4, 128]
  int height = 24; ///< [px]
  HaarFeatureSet features = HaarFeatureSet::kAll;
  /** from which each stage chooses; drawn anew for each, by the seed; > 0 */
  std::size_t features_per_stage = 10000;
  std::size_t features_per_tree = 2000; ///< drawn from them for each tree; > 0
  int stages = 10;                      ///< at most; > 0
  int splits = 1;                       ///< nodes of each tree, in [1, 16]
  int max_trees = 100;                  ///< of a stage; > 0
  double min_hit_rate = 0.998;          ///< of each stage, in (0, 1]
  double max_false_alarm = 0.4;         ///< of each stage, in (0, 1)
  std::size_t negatives = 3000;         ///< for each stage, in [10, 20000]
  double target_false_alarm = 0; ///< of the cascade on the backgrounds: then it ends
  double scale_factor = 1.2;     ///< between the sizes of negatives, in (1, 2]
  std::uint64_t seed = 1;        ///< same seed, same cascade
  unsigned int num_threads = 0;  ///< 0: one per core; never changes the result
  std::filesystem::path state;   ///< folder to go on from and for what is done; or none
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief How a stage did on what it was trained with. */
struct StageReport {
  std::size_t trees = 0;
  std::size_t positives = 0; ///< that reached it
  std::size_t negatives = 0; ///< false alarms of the stages before
  double hit_rate = 0;       ///< of the stage
  double false_alarm = 0;    ///< of the stage
  double background = 0;     ///< share of the backgrounds' windows that reached it
};

/** \brief Why the training ended. */
enum class TrainingEnd {
  kAllStages,
  kTargetReached,  ///< target_false_alarm, or no negatives are left
  kCannotSeparate, ///< max_trees did not reach max_false_alarm; the stage is kept
};

struct CascadeTraining {
  HaarCascade cascade;
  std::vector<StageReport> stages;
  TrainingEnd end = TrainingEnd::kAllStages;
  std::size_t resumed_stages = 0; ///< that were taken from the state
};

/** \brief Trains a cascade: each stage by Gentle AdaBoost on the positives and on false
 * alarms of the stages before it, found in the backgrounds (bootstrapping).
 *
 * A stage is finished when its threshold, set so that min_hit_rate of the positives pass,
 * lets at most max_false_alarm of the negatives through. Windows of low contrast do not
 * count, as the detector passes over them too. Same bits for any number of threads, and
 * whether or not it was interrupted.
 * \param[in] positives windows of the object, of the options' size
 * \param[in] backgrounds images of any size without it; of those with a gate, windows
 * count that pass it
 * \param[in] on_stage called after each stage, also after those from the state
 * \throws BadArgument an option breaks its rule, fewer than 10 positives with contrast,
 * one of another size, or no background with a window of enough contrast
 * \throws IoFailed the state belongs to another training or cannot be read or written
 * \note Source: Viola and Jones, CVPR 2001; Lienhart, Kuranov, Pisarevsky, DAGM 2003.
 * \ingroup object_localization */
CascadeTraining
trainCascade(const std::vector<GrayImage>& positives,
             const std::vector<BackgroundImage>& backgrounds,
             const CascadeTrainingOptions& options = {},
             const std::function<void(const StageReport&)>& on_stage = {},
             const ProgressCallback& progress = {});

} // namespace pcl6d
