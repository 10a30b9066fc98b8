// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "proposals/support_planes.h"

#include <cstdint>
#include <vector>

/** \file Surfels that are next to each other. Internal to the module
 * object_localization. */
namespace pcl6d::object_localization {

/** \brief Two surfels that are near each other. */
struct SurfelLink {
  std::uint32_t other = 0; ///< its place in SurfelGraph::surfels
  float distance = 0;      ///< [m]
  /** sine of the angle between a tangent plane and the chord, the smaller one of both
   * ends: > 0 where the surface bends inwards, < 0 outwards */
  float concavity = 0;
  bool adjacent = false; ///< no gap between them
};

/** \brief Some surfels and their links. */
struct SurfelGraph {
  std::vector<std::uint32_t> surfels; ///< places in the Surfels, ascending
  std::vector<float> spacings;        ///< [m] of the scan, at each
  std::vector<std::uint32_t> begin;   ///< first link of each, and the end
  std::vector<SurfelLink> links;      ///< of each, nearest first

  std::size_t
  size() const
  {
    return surfels.size();
  }
};

/** \param[in] surfels to link
 * \param[in] angular_spacing [rad] of the scan */
SurfelGraph
linkSurfels(const PlaneCloud& cloud,
            std::vector<std::uint32_t> surfels,
            double angular_spacing,
            const ProposalOptions& options);

/** \brief Sets of places in a graph, each ascending, in the order of their first. */
using SurfelSets = std::vector<std::vector<std::uint32_t>>;

/** \return what hangs together: by adjacency, and over wider gaps on one plane, as a table
 * that is seen at a grazing angle */
SurfelSets
connectedSets(const PlaneCloud& cloud,
              const SurfelGraph& graph,
              const SceneSupports& supports);

/** \return what of some places in a graph hangs together by adjacency
 * \param[in] mask of each place of the graph whether it counts */
SurfelSets
connectedSets(const SurfelGraph& graph, const std::vector<char>& mask);

} // namespace pcl6d::object_localization
