// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/detection_views.h>
#include <pcl6d/object_localization/haar_cascade.h>
#include <pcl6d/object_localization/window_gate.h>

#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief How the detections of two cascades are combined. */
enum class DetectionRule {
  kAnd, ///< found by both cascades: fewer false alarms
  kOr   ///< found by either cascade: fewer misses
};

/** \return the rule called "and" or "or" \throws BadArgument another name */
DetectionRule
detectionRuleFromName(const std::string& name);

/** \brief Knobs of ObjectDetector. */
struct DetectorOptions {
  DetectionViewOptions views; ///< pixel and slice_depth: overridden by the cascades
  DetectionRule rule = DetectionRule::kAnd; ///< used if there are two cascades
  double scale_factor = 1.1; ///< ratio of successive window sizes, in (1, 2]
  /** overlapping windows needed for a detection, >= 1. An object may be visible in two
   * slices of range, but in only one reflectance picture. */
  int min_neighbours_range = 8;
  int min_neighbours_reflectance = 6;
  /** largest factor between the height of a window and the height of the object at its
   * distance; > 1 */
  double size_tolerance = kSizeTolerance;
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief The picture that showed an object. */
enum class DetectionSource { kRange, kReflectance, kBoth };

/** \brief An object found in a view of a scan. */
struct DetectedObject {
  std::size_t view = 0;
  ImageRect box;    ///< in the view
  double score = 0; ///< number of windows in agreement; larger is more certain
  DetectionSource source = DetectionSource::kRange;
  double range = 0;                ///< [m] to the middle of the box
  std::vector<std::size_t> points; ///< of the scan, in the box and about at this range
};

/** \brief Finds objects of one class in a scan by cascades, in its range and
 * reflectance pictures (book 7.2.1). One object may appear in two overlapping views.
 * \code
 * const pcl6d::ObjectDetector detector(pcl6d::readCascade("chair.xml"));
 * for (const auto& chair : detector.detect(pcl6d::toPoints(cloud)))
 *   look(cloud, chair.points);
 * \endcode
 * \note Source: A. Nuechter, H. Surmann, J. Hertzberg, "Automatic classification of
 * objects in 3D laser range scans", IAS 2004. \ingroup object_localization */
class ObjectDetector {
public:
  /** \param[in] cascade with a subject, see CascadeSubject
   * \param[in] other cascade of the other channel
   * \throws BadArgument an option is invalid, a cascade is broken or without a subject,
   * or both cascades are of one channel or of pictures that differ in kind */
  explicit ObjectDetector(HaarCascade cascade,
                          const DetectorOptions& options = {},
                          std::optional<HaarCascade> other = {});

  /** \param[in] points [m] in the scan's frame, z up, the scanner at the origin
   * \param[in] reflectance one per point, or empty if no cascade needs reflectances
   * \return view by view, highest score first
   * \throws BadArgument a cascade needs reflectances, or not one reflectance per
   * point */
  std::vector<DetectedObject>
  detect(const Points& points, const std::vector<float>& reflectance = {}) const;

  const DetectionViews&
  views() const
  {
    return views_;
  }

private:
  struct Hit;
  std::vector<DetectedObject>
  detectIn(std::size_t view, const RangeImage& image, const HaarCascade& cascade) const;
  std::vector<Hit>
  hitsOf(const GrayImage& picture,
         const DepthSlice& slice,
         const RangeImage& image,
         const HaarCascade& cascade) const;
  std::vector<DetectedObject>
  grouped(const std::vector<Hit>& hits, std::size_t view, DetectionSource source) const;
  bool
  areOne(const DetectedObject& a, const DetectedObject& b) const;
  std::vector<DetectedObject>
  combined(std::vector<DetectedObject> a, const std::vector<DetectedObject>& b) const;

  DetectorOptions options_;
  DetectionViews views_;
  std::vector<HaarCascade> cascades_;
};

} // namespace pcl6d
