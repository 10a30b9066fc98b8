// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/plane.h>
#include <pcl6d/common/status.h>
#include <pcl6d/plane_segmentation/plane_segment.h>
#include <pcl6d/scene_interpretation/label_rules.h>

#include <Eigen/Core>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of interpretScene(). */
struct InterpretationOptions {
  RelationTolerances tolerances;
  /// direction up in the map; default: estimated from the planes, see estimateUp()
  std::optional<Eigen::Vector3d> up = Eigen::Vector3d::UnitZ();
  double max_tilt = 0.7853981633974483; ///< [rad] from +z, if estimated; in (0, pi/2)
  /// [m] position of the sensor; decides the visible side of planes where it is unknown
  std::optional<Eigen::Vector3d> sensor;
  double min_headroom = 1.8;        ///< [m] from the floor of a storey upwards; > 0
  double min_floor_area = 2;        ///< [m^2] of a plane that defines a storey; >= 0
  std::size_t node_limit = 1000000; ///< of the search; > 0
  unsigned int num_threads = 0;     ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief A label rejected for a plane, with the reason. */
struct RejectedLabel {
  std::string label;
  std::string reason;                 ///< in words, partner included
  std::optional<std::size_t> partner; ///< index of the conflicting plane
};

/** \brief Reasons for a plane's label. */
struct LabelExplanation {
  std::string reason; ///< for the label of the plane
  std::vector<RejectedLabel>
      rejections; ///< every other label, in the order of the rules
};

/** \brief A storey of a building: its planes are interpreted separately. */
struct Storey {
  std::optional<double> floor;   ///< [m] along Interpretation::up
  std::optional<double> ceiling; ///< [m] of its largest ceiling
  double area = 0;               ///< [m^2] of its floor
};

/** \brief Labels and storeys of the planes of a scene. Indices refer to the input
 * planes. */
struct Interpretation {
  Status status = Status::kOk; ///< kMaxIterations: node limit reached, best result up
                               ///< to then
  std::vector<std::string> labels;
  std::vector<LabelExplanation> explanations;
  std::vector<std::size_t> storey_of; ///< per plane
  std::vector<Storey> storeys;        ///< from the lowest floor up; at least one
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  std::size_t nodes = 0; ///< assignments tried by the search
};

/** \brief Labels planes so that every constraint holds and the labelled area is largest
 * (book 7.1.2). Of equal labellings the first wins, planes compared by falling area,
 * labels by their order in the rules.
 *
 * Planes are assigned to storeys first: a floor is a level plane seen from above with
 * headroom over the next floor below. Constraints bind planes of one storey; needs may
 * be met by any plane. Per storey the search is exact within node_limit.
 * \param[in] seen_from per plane the direction towards the sensor; zero, or an empty
 * list: unknown, and rules on the side hold
 * \throws BadArgument an option is invalid, a plane is not finite, or the lists differ
 * in length
 * \note Source: A. Nüchter, J. Hertzberg, "Towards semantic maps for mobile robots",
 * Robotics and Autonomous Systems 56(11), 2008. \ingroup scene_interpretation */
Interpretation
interpretPlanes(const std::vector<Plane>& planes,
                const std::vector<Eigen::Vector3d>& seen_from,
                const LabelRules& rules = bookRules(),
                const InterpretationOptions& options = {});

/** \brief Labels the planes of a segmentation, see interpretPlanes(). */
Interpretation
interpretScene(const std::vector<PlaneSegment>& segments,
               const LabelRules& rules = bookRules(),
               const InterpretationOptions& options = {});

/** \brief Writes the labels into the planes. \throws BadArgument not one label per
 * plane */
void
applyLabels(const Interpretation& interpretation, std::vector<PlaneSegment>& segments);

/** \brief Estimates the direction up. Candidates are the normals and the intersection
 * lines of two planes. The best candidate is parallel or orthogonal, within tau, to the
 * most area; of about equal candidates the nearest to +z wins. The result is refined
 * over its planes.
 * \return nullopt if no direction within max_tilt of +z agrees with a plane */
std::optional<Eigen::Vector3d>
estimateUp(const std::vector<Plane>& planes, double tau, double max_tilt);

/** \return the explanation of one plane in lines of text, the first without indent */
std::string
explanationText(const Interpretation& interpretation, std::size_t plane);

/** \brief Writes labels, storeys and explanations as JSON, atomically; the id of a
 * plane is its index plus one. \throws IoFailed the file cannot be written */
void
writeInterpretation(const std::filesystem::path& path,
                    const Interpretation& interpretation);

} // namespace pcl6d
