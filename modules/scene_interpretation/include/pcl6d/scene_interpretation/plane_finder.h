// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/plane_segmentation/segment_planes.h>
#include <pcl6d/scene_interpretation/interpretation.h>
#include <pcl6d/scene_interpretation/model_refinement.h>
#include <pcl6d/scene_interpretation/scene_cloud.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of PlaneFinder: detection, labels and refinement. */
struct PlaneFinderOptions {
  PlaneMethod method = PlaneMethod::kRegionGrowing;
  PlaneSegmentationOptions segmentation;
  std::optional<double> noise; ///< [m] of a point; default: estimated
  bool labels = true;
  LabelRules rules = bookRules();
  InterpretationOptions interpretation;
  bool refine = false;
  RefinementOptions refinement; ///< its `up` is overridden by the `up` of
                                ///< interpretation, if set
  unsigned int num_threads = 0; ///< of every step; 0: one per core
};

/** \brief Result of PlaneFinder. */
struct FoundPlanes {
  PlaneSegments segments; ///< as measured, with labels
  Interpretation interpretation;
  std::optional<RefinedModel> refined;
  double seconds = 0; ///< from the points to the labelled planes

  /** \return the refined planes if available, else the measured planes */
  const std::vector<PlaneSegment>&
  best() const
  {
    return refined ? refined->planes : segments.planes;
  }
};

/** \brief Finds planes in points, labels them and, if wanted, makes them exact (book
 * 7.1): segmentation, labels and refinement in one call. Bit for bit equal for any
 * number of threads. \code
 * pcl6d::SceneCloud cloud;
 * cloud.points = points; // [m], the scanner at the origin
 * for (const auto& segment : pcl6d::PlaneFinder().find(cloud).segments.planes)
 *   use(segment.plane.label, segment.plane.hull);
 * \endcode
 * For a folder of scans or a run: `find(joinScans(scans, sceneParameters(scans)))`.
 * \ingroup scene_interpretation */
class PlaneFinder {
public:
  explicit PlaneFinder(PlaneFinderOptions options = {});

  /** \throws BadArgument an option is invalid */
  FoundPlanes
  find(const SceneCloud& cloud) const;

  /** \brief Writes planes.json (in the full coordinates of the world; refined planes if
   * available), planes.pcd, hulls.ply, labels.json if labelled, and refinement.json and
   * refined.pcd if refined.
   * \param[in] generator name of the program, written into planes.json
   * \throws IoFailed a file cannot be written */
  void
  write(const std::filesystem::path& folder,
        const SceneCloud& cloud,
        const FoundPlanes& found,
        const std::string& generator) const;

private:
  PlaneFinderOptions options_;
};

/** \return planes in the full coordinates of the world
 * \param[in] world_offset [m] added to the planes */
std::vector<Plane>
worldPlanes(const std::vector<PlaneSegment>& segments,
            const Eigen::Vector3d& world_offset);

} // namespace pcl6d
