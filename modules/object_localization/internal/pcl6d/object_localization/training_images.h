// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/progress.h>
#include <pcl6d/common/triangle_mesh.h>
#include <pcl6d/object_localization/detection_views.h>
#include <pcl6d/object_localization/object_model.h>
#include <pcl6d/object_localization/window_gate.h>
#include <pcl6d/scanner/scanner_presets.h>

namespace PCL6D_EXPORTS pcl6d {

/** \return a mesh of small squares on the points of a model, which occludes the
 * background like the object itself */
TriangleMesh
meshOfPoints(const ObjectModel& model);

/** \brief The detection window of an object. */
struct WindowShape {
  int width = 24;         ///< [px]
  int height = 24;        ///< [px]
  double object_size = 1; ///< [m] height of the window at the object's distance

  /** \return pixel size [rad] of the pictures at which an object at the given distance
   * [m] still fills the window: at most that of DetectionViewOptions */
  double
  pixelFor(double distance) const;
};

/** \return a window of about 576 pixels around upright models (z), in any heading, with
 * a margin
 * \throws BadArgument no model, a model without triangles, or larger than
 * ObjectModel::kLargestDiameter (is it in millimetres?) */
WindowShape
windowShapeOf(const std::vector<TriangleMesh>& models);

/** \brief A scan without the object. */
struct BackgroundScan {
  Points points;                  ///< [m] scanner at the origin, z up
  std::vector<float> reflectance; ///< one per point, or empty
};

/** \brief Knobs of makeTrainingImages(). */
struct TrainingImageOptions {
  ImageChannel channel = ImageChannel::kRange;
  std::size_t positives = 1000; ///< in [1, SortedFeatures::kMostPositives]
  double min_distance = 1.5;    ///< [m] in plan, > 0
  double max_distance = 5;      ///< [m] > min_distance
  double min_visible = 0.4;     ///< share of the samples on the object, in (0, 1]
  double size_tolerance = kSizeTolerance; ///< of the detector, see WindowGate; > 1
  double min_reflectance = 0.3; ///< of the object, drawn anew each time; in [0, 1]
  double max_reflectance = 0.8; ///< >= min_reflectance, <= 1
  std::size_t min_samples = 25; ///< of the scanner on the object, > 0
  std::uint64_t seed = 1;       ///< equal seeds give equal images
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Input of trainCascade(). */
struct TrainingImages {
  std::vector<GrayImage> positives;         ///< of the window's size
  std::vector<BackgroundImage> backgrounds; ///< pictures of the unchanged scans
};

/** \brief Puts models into scans and cuts out the windows that a detector would see.
 *
 * Each positive uses a scan, a free position on its floor, a heading and a distance,
 * drawn by the seed. The model is measured there with the scanner's pattern and noise
 * and occludes the background. The window is off the object by a few per cent and
 * passes the detector's WindowGate. The images are equal for any number of threads.
 * \param[in] models upright (z), standing on their lowest point
 * \throws BadArgument an option is invalid, no scans, or a scan lacks reflectances
 * where the channel needs them
 * \throws ComputeFailed no free position was found for many positives (the message
 * names the most frequent reason) \ingroup object_localization */
TrainingImages
makeTrainingImages(const std::vector<TriangleMesh>& models,
                   const WindowShape& window,
                   const ScannerPreset& scanner,
                   const std::vector<BackgroundScan>& scans,
                   const DetectionViews& views,
                   const TrainingImageOptions& options = {},
                   const ProgressCallback& progress = {});

} // namespace pcl6d
