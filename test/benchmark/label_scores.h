// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/labelled_map.h"

#include <pcl6d/scene_interpretation/interpretation.h>

#include <map>
#include <set>
#include <vector>

/** \file Labels of a simulated scene measured against the truth. */
namespace pcl6d::test {

struct Scores {
  double labelled = 0, right = 0; // [m^2] floor, ceiling, wall as found
  double truth = 0, covered = 0;  // [m^2] on planes found, by the label of its points
  std::size_t faces = 0, faces_found = 0; // of doors
  std::set<std::uint32_t> doors, doors_found;
  std::size_t claimed = 0, confirmed = 0;
};

/** \return the true planes of a segment's points: the share of each id */
std::map<std::uint32_t, double>
sharesOf(const LabelledMap& map, const PlaneSegment& segment);

/** \return the id with the largest share */
std::uint32_t
largestOf(const std::map<std::uint32_t, double>& shares);

/** \brief Adds what was found of a scene. \param[in] is_verbose print what is wrong */
void
scoreSegments(const LabelledMap& map,
              const std::vector<PlaneSegment>& segments,
              const Interpretation& labels,
              bool is_verbose,
              Scores& scores);

} // namespace pcl6d::test
