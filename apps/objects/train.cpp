// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/progress_bar.h"
#include "objects/train_settings.h"
#include "objects/verbs.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/text.h>
#include <pcl6d/object_localization/cascade_file.h>
#include <pcl6d/object_localization/model_store.h>

#include <chrono>
#include <cstdio>
#include <filesystem>

namespace pcl6d::app {
namespace {
namespace fs = std::filesystem;

/** A folder of the store, or a file. */
TriangleMesh
readModel(const std::string& path, const MeshOptions& units)
{
  TriangleMesh mesh = fs::is_directory(path)
                          ? readStoredModel(path).mesh
                          : readModelFile(path, {units, "model"}).mesh;
  windowShapeOf({mesh}); // checks its size
  return mesh;
}

BackgroundScan
toBackground(const Scan& scan)
{
  BackgroundScan background;
  background.points = scan.points;
  if (const auto field = fieldValues(scan.cloud, "intensity"))
    background.reflectance.assign(field->values.begin(), field->values.end());
  return background;
}

std::vector<BackgroundScan>
readBackgrounds(const TrainSettings& s, ProgressBar& bar)
{
  std::vector<BackgroundScan> scans;
  for (const auto& path : s.backgrounds) {
    if (!fs::is_directory(path)) {
      scans.push_back(toBackground(readScan(path)));
      continue;
    }
    ScanFolderOptions options;
    options.every = s.every;
    const ScanFolder folder(path, options);
    for (std::size_t i = 0; i < folder.size(); ++i) {
      scans.push_back(toBackground(folder.read(i)));
      bar.show({"reading", i + 1, folder.size()});
    }
  }
  return scans;
}

void
printStage(std::size_t number, const StageReport& stage)
{
  std::printf("%5zu %6zu %10zu %10zu %9.4f %12.4f %11.2e\n",
              number,
              stage.trees,
              stage.positives,
              stage.negatives,
              stage.hit_rate,
              stage.false_alarm,
              stage.background * stage.false_alarm);
  std::fflush(stdout);
}

int
finish(const TrainSettings& s, CascadeTraining& training, double seconds)
{
  double hits = 1;
  for (const auto& stage : training.stages)
    hits *= stage.hit_rate;
  std::printf("window %d %d\nhit rate %.4f\nseconds %.1f\n",
              training.cascade.width,
              training.cascade.height,
              hits,
              seconds);
  flushOutput();
  if (training.stages.empty())
    throw ComputeFailed(
        "no feature in the pictures tells the object from the backgrounds");
  writeCascade(s.output, training.cascade);
  if (training.end != TrainingEnd::kCannotSeparate)
    return kDone;
  std::fprintf(stderr,
               "%s: the result is not to be trusted: --max-trees did not reach "
               "--max-false-alarm in stage %zu\n",
               kObjects,
               training.stages.size());
  return kDoubtful;
}

int
train(TrainSettings& s, const ProgressCallback& progress, ProgressBar& bar)
{
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  std::vector<TriangleMesh> models;
  for (const auto& file : s.models)
    models.push_back(readModel(file, s.mesh));
  const WindowShape window = windowShapeOf(models);
  s.training.width = window.width;
  s.training.height = window.height;
  if (s.views.pixel == 0)
    s.views.pixel = window.pixelFor(s.images.max_distance);
  const DetectionViews views(s.views);
  const auto scans = readBackgrounds(s, bar);
  const TrainingImages images =
      makeTrainingImages(models, window, s.scanner, scans, views, s.images, progress);
  std::printf(
      "stage  trees  positives  negatives  hit-rate  false-alarm  background\n");
  std::size_t number = 0;
  CascadeTraining training = trainCascade(
      images.positives,
      images.backgrounds,
      s.training,
      [&](const StageReport& stage) { printStage(++number, stage); },
      progress);
  training.cascade.subject = CascadeSubject{
      s.images.channel, window.object_size, s.views.pixel, s.views.slice_depth};
  return finish(
      s, training, std::chrono::duration<double>(Clock::now() - start).count());
}
} // namespace

int
runTrain(const std::vector<std::string>& arguments)
{
  TrainSettings s;
  if (!parseTrain(arguments, s))
    return kDone;
  const std::filesystem::path folder = std::filesystem::path(s.output).parent_path();
  if (folder.empty() || text::isThere(folder)) // otherwise --state may make it
    requireWritable(s.output);
  const Interrupt interrupt;
  ProgressBar bar(s.quiet);
  try {
    return train(s, watched(bar, interrupt), bar);
  } catch (const Interrupted&) {
    bar.warn("interrupted; the same command goes on from " + s.state);
    return kInterrupted;
  }
}

} // namespace pcl6d::app
