// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "proposals/plane_prism.h"

#include <pcl6d/object_localization/object_proposals.h>

#include <cstdint>
#include <limits>
#include <vector>

/** \file Roles of the planes of a scene as supports of objects. Internal to the module
 * object_localization. */
namespace pcl6d::object_localization {

/** \brief The role of a plane. */
enum class PlaneRole {
  kThing,     ///< possibly part of an object
  kRaised,    ///< level, possibly part of an object and a support of others
  kBase,      ///< supports objects, not part of an object
  kStructure, ///< not a support and not part of an object, such as a wall
};

/** \brief The planes of a scene with their roles. */
struct SceneSupports {
  static constexpr std::uint32_t kNoPlane = std::numeric_limits<std::uint32_t>::max();

  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  std::vector<PlanePrism> prisms;             ///< one per plane
  std::vector<PlaneRole> roles;               ///< one per plane
  std::vector<std::uint32_t> plane_of_surfel; ///< or kNoPlane
};

SceneSupports
findSupports(const PlaneCloud& cloud,
             const PlaneSegments& planes,
             const ProposalOptions& options);

/** \return the surfels that may be on objects: over a base, not on a base or structure;
 * ascending */
std::vector<std::uint32_t>
surfelsOfThings(const PlaneCloud& cloud,
                const SceneSupports& supports,
                const ProposalOptions& options);

} // namespace pcl6d::object_localization
