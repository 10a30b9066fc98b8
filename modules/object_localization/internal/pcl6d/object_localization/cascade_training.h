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
  /** candidates of a stage, drawn anew for each stage by the seed; > 0 */
  std::size_t features_per_stage = 10000;
  std::size_t features_per_tree = 2000; ///< drawn from a stage's candidates; > 0
  int stages = 10;                      ///< at most; > 0
  int splits = 1;                       ///< nodes of each tree, in [1, 16]
  int max_trees = 100;                  ///< of a stage; > 0
  double min_hit_rate = 0.998;          ///< of each stage, in (0, 1]
  double max_false_alarm = 0.4;         ///< of each stage, in (0, 1)
  std::size_t negatives = 3000;         ///< for each stage, in [10, 20000]
  double target_false_alarm = 0; ///< in [0, 1): training ends when at most this share
                                 ///< of background windows passes the cascade
  double scale_factor = 1.2;     ///< between the sizes of negatives, in (1, 2]
  std::uint64_t seed = 1;        ///< equal seeds give equal cascades
  unsigned int num_threads = 0;  ///< 0: one per core; never changes the result
  std::filesystem::path state;   ///< folder that keeps finished stages, to resume from;
                                 ///< empty: no folder
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Size and error rates of a stage on its training windows. */
struct StageReport {
  std::size_t trees = 0;
  std::size_t positives = 0; ///< windows that reached the stage
  std::size_t negatives = 0; ///< false alarms of the stages before
  double hit_rate = 0;       ///< of the stage
  double false_alarm = 0;    ///< of the stage
  double background = 0;     ///< share of background windows that reached the stage
};

/** \brief Why the training ended. */
enum class TrainingEnd {
  kAllStages,
  kTargetReached,  ///< target_false_alarm, or fewer than 10 negatives left
  kCannotSeparate, ///< max_trees did not reach max_false_alarm; the stage is kept
};

struct CascadeTraining {
  HaarCascade cascade;
  std::vector<StageReport> stages;
  TrainingEnd end = TrainingEnd::kAllStages;
  std::size_t resumed_stages = 0; ///< taken from the state
};

/** \brief Trains a cascade: each stage by Gentle AdaBoost on the positives and on false
 * alarms of the stages before it, found in the backgrounds (bootstrapping).
 *
 * The threshold of a stage lets min_hit_rate of the positives pass. A stage is finished
 * when at most max_false_alarm of the negatives pass, too. Windows of low contrast are
 * ignored, as the detector skips them. The result is equal bit for bit for any number
 * of threads, and after an interruption.
 * \param[in] positives windows of the object, of the options' size
 * \param[in] backgrounds images of any size without the object; where an image has a
 * gate, only windows that pass the gate count
 * \param[in] on_stage called after each stage, also after stages from the state
 * \throws BadArgument an option is invalid, fewer than 10 positives with contrast, a
 * positive of another size, or no background with a window of enough contrast
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
