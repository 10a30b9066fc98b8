// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/simulation/ground_map.h>
#include <pcl6d/simulation/ray_caster.h>

#include <Eigen/Core>

#include <memory>
#include <vector>

/** \file Free floor for bodies, computed from a scene or from scans. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief Finds the floor below a scanner's track, as far as a person can walk from
 * there: with 2 m of free height, without steps and slopes of more than 20 %.
 * \param[in] places of the scanner [m], in the scene, close to each other
 * \param[in] height of the scanner above the floor [m]
 * \param[in] reach [m] from the places in plan, > 0
 * \return cells of 0.1 m, or 0.2 m for a long track. Rays are cast down onto each cell
 * and to its eight neighbours at 0.25, 0.9 and 1.6 m above the floor, to detect any
 * object as high as a table and wider than 0.7 cells
 * \throws BadArgument no place, or reach is invalid
 * \throws ComputeFailed no floor below the scanner, or an area of more than 10 million
 * cells \ingroup simulation */
GroundMap
groundOfScene(const RayCaster& caster,
              const std::vector<Eigen::Vector3d>& places,
              double height,
              double reach);

/** \brief Finds the floor in scans: level points below the scanner, extended to
 * neighbours that differ by at most 0.1 m and 20 %. A cell is free if its floor was
 * measured or interpolated (over gaps of 1 m, and of 4 m where rays passed through),
 * without other points up to 2 m above.
 * \ingroup simulation */
class GroundSurvey {
public:
  /** \param[in] places of the scanner [m], z up
   * \param[in] reach [m] in plan from the places, farther points are ignored; > 0
   * \throws BadArgument no place, or reach is invalid
   * \throws ComputeFailed the area is larger than 10 million cells of 0.5 m */
  GroundSurvey(const std::vector<Eigen::Vector3d>& places, double reach);

  ~GroundSurvey();

  /** \param[in] measured points of the scan from place i, in the frame of the places [m] */
  void
  add(std::size_t i, const Points& measured);

  /** \return the free floor \throws ComputeFailed no floor was found below any place */
  GroundMap
  map() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace pcl6d
