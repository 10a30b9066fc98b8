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

/** \brief How planes are found, labelled and refined. */
struct PlaneFinderOptions {
  PlaneMethod method = PlaneMethod::kRegionGrowing;
  PlaneSegmentationOptions segmentation;
  std::optional<double> noise; ///< [m] of a point; none: estimated
  bool labels = true;
  LabelRules rules = bookRules();
  InterpretationOptions interpretation;
  bool refine = false;
  RefinementOptions refinement; ///< its `up` is that of interpretation, if given there
  unsigned int num_threads = 0; ///< of all steps; 0: one per core
};

/** \brief What PlaneFinder found. */
struct FoundPlanes {
  PlaneSegments segments; ///< as measured, with labels
  Interpretation interpretation;
  std::optional<RefinedModel> refined;
  double seconds = 0; ///< from the points to the labelled planes

  /** \return the planes, refined if they were */
  const std::vector<PlaneSegment>&
  best() const
  {
    return refined ? refined->planes : segments.planes;
  }
};

/** \brief From points to labelled planes, exact ones if wanted (book 7.1): segmentation,
 * labels and refinement in one call. The same bits for any number of threads. \code
 * pcl6d::SceneCloud cloud;
 * cloud.points = points; // [m], the scanner at the origin
 * for (const auto& segment : pcl6d::PlaneFinder().find(cloud).segments.planes)
 *   use(segment.plane.label, segment.plane.hull);
 * \endcode
 * Of a folder of scans or a run: `find(joinScans(scans, sceneParameters(scans)))`.
 * \ingroup scene_interpretation */
class PlaneFinder {
public:
  explicit PlaneFinder(PlaneFinderOptions options = {});

  /** \throws BadArgument an option breaks its rule */
  FoundPlanes
  find(const SceneCloud& cloud) const;

  /** \brief Writes planes.json (in the full coordinates of the world; refined ones, if
   * there are), planes.pcd, hulls.ply, with labels labels.json and, if refined,
   * refinement.json and refined.pcd.
   * \param[in] generator the program, as it stands in planes.json
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
 * \param[in] world_offset [m] that their points are relative to */
std::vector<Plane>
worldPlanes(const std::vector<PlaneSegment>& segments,
            const Eigen::Vector3d& world_offset);

} // namespace pcl6d
