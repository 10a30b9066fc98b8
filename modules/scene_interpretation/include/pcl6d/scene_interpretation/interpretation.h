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
  /// direction up in the map; none: estimated from the planes, see estimateUp()
  std::optional<Eigen::Vector3d> up = Eigen::Vector3d::UnitZ();
  double max_tilt = 0.7853981633974483; ///< [rad] of +z, if estimated; in (0, pi/2)
  /// [m] where all was seen from; tells the side of planes for which it is not known
  std::optional<Eigen::Vector3d> sensor;
  double min_headroom = 1.8;        ///< [m] from the floor of a storey upwards; > 0
  double min_floor_area = 2;        ///< [m^2] of a plane that makes a storey; >= 0
  std::size_t node_limit = 1000000; ///< of the search; > 0
  unsigned int num_threads = 0;     ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief A label that a plane does not carry, and why. */
struct Rejection {
  std::string label;
  std::string reason;                 ///< in words, partner included
  std::optional<std::size_t> partner; ///< place of the plane that forbids it
};

/** \brief Why a plane carries its label. */
struct LabelExplanation {
  std::string reason;                ///< for the label that it carries
  std::vector<Rejection> rejections; ///< all other labels, in the order of the rules
};

/** \brief A floor of a building: its planes are interpreted on their own. */
struct Storey {
  std::optional<double> floor;   ///< [m] along Interpretation::up
  std::optional<double> ceiling; ///< [m] of its largest ceiling
  double area = 0;               ///< [m^2] of its floor
};

/** \brief What the planes of a scene are. Places are those of the planes given. */
struct Interpretation {
  Status status = Status::kOk; ///< kMaxIterations: the node limit; the best so far
  std::vector<std::string> labels;
  std::vector<LabelExplanation> explanations;
  std::vector<std::size_t> storey_of; ///< per plane
  std::vector<Storey> storeys;        ///< from the lowest floor up; at least one
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  std::size_t nodes = 0; ///< assignments that the search tried
};

/** \brief Labels planes so that all constraints hold and as much area as possible has a
 * label; of several such labellings the first, planes compared by falling area, labels
 * by their order in the rules (book 7.1.2).
 *
 * Planes are told apart by storey first: a floor is a level plane seen from above with
 * headroom over the next one below it. Constraints bind planes of one storey; needs may
 * be met by any plane. Per storey the search is exact within node_limit.
 * \param[in] seen_from per plane the direction towards where it was seen from; zero, or
 * an empty list: not known, so that rules that ask for a side are kept
 * \throws BadArgument an option breaks its rule, a plane is not finite, or the lists
 * differ in length
 * \note Source: A. Nüchter, J. Hertzberg, "Towards semantic maps for mobile robots",
 * Robotics and Autonomous Systems 56(11), 2008. \ingroup scene_interpretation */
Interpretation
interpretPlanes(const std::vector<Plane>& planes,
                const std::vector<Eigen::Vector3d>& seen_from,
                const LabelRules& rules = bookRules(),
                const InterpretationOptions& options = {});

/** \brief The same for the planes of a segmentation. */
Interpretation
interpretScene(const std::vector<PlaneSegment>& segments,
               const LabelRules& rules = bookRules(),
               const InterpretationOptions& options = {});

/** \brief Writes the labels into the planes. \throws BadArgument not as many labels */
void
applyLabels(const Interpretation& interpretation, std::vector<PlaneSegment>& segments);

/** \brief The direction to which most area is parallel or orthogonal, within tau, among
 * the normals and the crossings of two normals; of several the one nearest to +z. Then
 * the best for all of these planes together.
 * \return none if no direction within max_tilt of +z has a plane for it */
std::optional<Eigen::Vector3d>
estimateUp(const std::vector<Plane>& planes, double tau, double max_tilt);

/** \return the explanation of one plane as lines of text, the first without indent */
std::string
explanationText(const Interpretation& interpretation, std::size_t plane);

/** \brief Writes labels, storeys and explanations as JSON, atomically; the id of a
 * plane is its place plus one. \throws IoFailed the file cannot be written */
void
writeInterpretation(const std::filesystem::path& path,
                    const Interpretation& interpretation);

} // namespace pcl6d
