// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/simulation/ground_map.h>
#include <pcl6d/simulation/ray_caster.h>

#include <Eigen/Core>

#include <memory>
#include <vector>

/** \file Two ways to know where bodies can go: from a scene, and from scans of a place. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief The floor that a scanner drives over, as far as one can walk from there: with
 * 2 m of free height, without a step or a slope of more than 20 %.
 * \param[in] places of the scanner [m], in the scene, close to each other
 * \param[in] height of the scanner above the floor [m]
 * \param[in] reach [m] from the places in plan, > 0
 * \return cells of 0.1 m, of 0.2 m where the places are far apart. Rays look down onto each
 * cell and to its eight neighbours 0.25, 0.9 and 1.6 m above the floor, so nothing that is
 * as high as a table and wider than 0.7 cells is missed
 * \throws BadArgument no place, or reach breaks its rule
 * \throws ComputeFailed there is no floor below the scanner, or the area is larger than 10
 * million cells \ingroup simulation */
GroundMap
groundOfScene(const RayCaster& caster,
              const std::vector<Eigen::Vector3d>& places,
              double height,
              double reach);

/** \brief Finds the floor in scans of a place: level points below the scanner, and on from
 * there where neighbours differ by 0.1 m and 20 % at most. A cell is free where its floor
 * was measured, or is that of its neighbours (over gaps of 1 m, and of 4 m where rays went
 * through), and where nothing else was measured up to 2 m above it.
 * \ingroup simulation */
class GroundSurvey {
public:
  /** \param[in] places of the scanner [m], z up
   * \param[in] reach [m] in plan from the places, farther points do not count; > 0
   * \throws BadArgument no place, or reach breaks its rule
   * \throws ComputeFailed the area is larger than 10 million cells of 0.5 m */
  GroundSurvey(const std::vector<Eigen::Vector3d>& places, double reach);

  ~GroundSurvey();

  /** \param[in] measured points of the scan from place i, in the frame of the places [m] */
  void
  add(std::size_t i, const Points& measured);

  /** \return where bodies can go \throws ComputeFailed below no place was a floor seen */
  GroundMap
  map() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace pcl6d
