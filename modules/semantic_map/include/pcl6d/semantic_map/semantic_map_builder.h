// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/common/progress.h>
#include <pcl6d/scene_interpretation/label_rules.h>
#include <pcl6d/scene_interpretation/plane_finder.h>
#include <pcl6d/semantic_map/point_labels.h>
#include <pcl6d/semantic_map/semantic_map.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of SemanticMapBuilder. */
struct SemanticMapBuilderOptions {
  bool fuse = true;              ///< fuse observations of one object from several scans
  std::size_t least_points = 10; ///< of a scan on an observed plane or object
  unsigned int num_threads = 0;  ///< 0: one per core; never changes the result
};

/** \brief Builds a semantic map (book 7.3) from registered scans, planes and objects:
 * observations per scan, rooms, relations, and labels of points. \code
 * pcl6d::SemanticMap scans;
 * scans.scans = {{0, "scan000.pcd", T_world_scan, {}}};
 * pcl6d::SemanticMapBuilder builder(scans);
 * builder.setObjects(observations);                 // of ObjectFinder, or none
 * builder.setPlanes(pcl6d::PlaneFinder().find(cloud), cloud.world_offset);
 * builder.build(cloud.points, [&](std::size_t i) { return points_of_scan[i]; });
 * writeSemanticMap("semantic_map.json", builder.map());
 * \endcode
 * \ingroup semantic_map */
class SemanticMapBuilder {
public:
  /** \return the points [m] of the i-th scan, in its own frame */
  using ReadPoints = std::function<Points(std::size_t i)>;

  /** \param[in] scans the scans of the map, their links and the world offset */
  explicit SemanticMapBuilder(SemanticMap scans,
                              const SemanticMapBuilderOptions& options = {});

  /** \param[in] observations one entry per object and scan, or per object
   * \param[in] source of the observations, for messages
   * \throws IoFailed an observation refers to a scan that is not in the map
   * \throws BadArgument see fuseObjects() */
  void
  setObjects(const std::vector<MapObject>& observations,
             const std::string& source = "objects");

  /** \param[in] planes in full coordinates; they are labelled if no plane has a label
   * \param[in] rules called for the rules of labels, if needed */
  void
  setPlanes(std::vector<Plane> planes,
            const std::function<LabelRules()>& rules = bookRules);

  /** \param[in] found planes, measured and, if moved by the refinement, refined
   * \param[in] world_offset [m] of the planes */
  void
  setPlanes(const FoundPlanes& found, const Eigen::Vector3d& world_offset);

  /** \brief Combines scans, objects and planes. Objects with a list of scans keep their
   * list.
   * \param[in] points of the map [m], relative to its world offset
   * \param[in] progress called with each scan ("scans"); its exceptions pass through */
  void
  build(const Points& points,
        const ReadPoints& read_scan,
        const ProgressCallback& progress = {});

  const SemanticMap&
  map() const
  {
    return map_;
  }

  /** \return labels of the points given to build() */
  const PointLabels&
  labels() const
  {
    return labels_;
  }

private:
  void
  findScansOfParts(const PointLabeller& labeller,
                   const ReadPoints& read_scan,
                   const ProgressCallback& progress);

  SemanticMapBuilderOptions options_;
  SemanticMap map_;
  PointLabels labels_;
};

/** \brief Adds the fields label, plane_id, object_id and rgb (the colour of the label)
 * to a cloud; existing fields are kept.
 * \param[in] label_names by number, SemanticMap::labelNames() */
void
addLabelFields(const PointLabels& labels,
               const std::vector<std::string>& label_names,
               pcl::PCLPointCloud2& cloud);

} // namespace pcl6d
