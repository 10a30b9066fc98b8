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

/** \brief What two cascades together take for an object. */
enum class DetectionRule {
  kAnd, ///< what both see: fewer false alarms
  kOr   ///< what either sees: fewer misses
};

/** \return the rule called "and" or "or" \throws BadArgument another name */
DetectionRule
detectionRuleFromName(const std::string& name);

/** \brief Knobs of ObjectDetector. */
struct DetectorOptions {
  DetectionViewOptions views; ///< pixel and slice_depth: those of the cascades count
  DetectionRule rule = DetectionRule::kAnd; ///< counts if there are two cascades
  double scale_factor = 1.1; ///< from one size of the window to the next, in (1, 2]
  /** overlapping windows that make a detection, >= 1. An object may be seen in two slices
   * of its ranges, but in one picture of its reflectances. */
  int min_neighbours_range = 8;
  int min_neighbours_reflectance = 6;
  /** by which the size of a window may differ from that of the object at its distance, as
   * a factor; > 1 */
  double size_tolerance = kSizeTolerance;
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Which picture showed an object. */
enum class DetectionSource { kRange, kReflectance, kBoth };

/** \brief An object found in a view of a scan. */
struct DetectedObject {
  std::size_t view = 0;
  ImageRect box;    ///< in that view
  double score = 0; ///< number of windows that agreed; larger is surer
  DetectionSource source = DetectionSource::kRange;
  double range = 0;                ///< [m] to the middle of the box
  std::vector<std::size_t> points; ///< of the scan, in the box and about that far
};

/** \brief Finds objects of one class in a scan by cascades, in its range and reflectance
 * pictures (book 7.2.1). The same object may appear in two views that overlap.
 * \code
 * const pcl6d::ObjectDetector detector(pcl6d::readCascade("chair.xml"));
 * for (const auto& chair : detector.detect(pcl6d::toPoints(cloud)))
 *   look(cloud, chair.points);
 * \endcode
 * \note Source: A. Nuechter, H. Surmann, J. Hertzberg, "Automatic classification of objects
 * in 3D laser range scans", IAS 2004. \ingroup object_localization */
class ObjectDetector {
public:
  /** \param[in] cascade that tells its subject, see CascadeSubject
   * \param[in] other one of the other channel
   * \throws BadArgument an option breaks its rule, a cascade is broken, does not tell its
   * subject, both look at the same channel, or at pictures of another kind */
  explicit ObjectDetector(HaarCascade cascade,
                          const DetectorOptions& options = {},
                          std::optional<HaarCascade> other = {});

  /** \param[in] points [m] in the scan's frame, z up, the scanner at the origin
   * \param[in] reflectance one per point, or empty if no cascade needs it
   * \return view by view, the surest first
   * \throws BadArgument a cascade needs reflectances, or their number is another */
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
