// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/filters/scan_parameters.h>
#include <pcl6d/global_registration/place_search.h>

#include <Eigen/Geometry>

#include <memory>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of PairPlacer. */
struct PairPlacerOptions {
  PlaceSearchOptions search = PlaceSearchOptions::forTwoScans();
  ScanParameterOptions parameters; ///< what is left open follows from each scan itself
  /** unit vectors in the frames of the scans: the sensors' own up, see estimateVertical() */
  Eigen::Vector3d target_up = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d source_up = Eigen::Vector3d::UnitZ();
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief What PairPlacer found. */
struct PairPlacement {
  PlaceResult result; ///< places of the source on the target
  /** the best place, matched by all points of both; none: identity */
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
};

/** \brief Places measured points on others without a guess: the compiled core of
 * GlobalRegistration. Each scan is made ready by its own range gate and voxel, so that a
 * target is made ready once for all sources, and what is found does not depend on what was
 * placed before. \ingroup global_registration */
class PairPlacer {
public:
  PairPlacer();
  ~PairPlacer();
  PairPlacer(PairPlacer&&) noexcept;
  PairPlacer&
  operator=(PairPlacer&&) noexcept;

  /** \throws BadArgument an option breaks its rule */
  void
  setOptions(const PairPlacerOptions& options);
  const PairPlacerOptions&
  options() const
  {
    return options_;
  }

  /** \brief Places a scan. What was made of a target, or a source, that is the same again
   * is used again.
   * \param[in] target, source [m] in the frames of their scanners, from whose origins they
   * were seen
   * \return never throws on data: kNone with the reason where there are too few points, or
   * they are too far apart for the voxels */
  PairPlacement
  place(const Points& target, const Points& source);

private:
  struct Prepared;

  /** \return what was made of points, made again if they, or the options, are others */
  const Prepared&
  prepared(std::unique_ptr<Prepared>& kept,
           const Points& points,
           const Eigen::Vector3d& up,
           const char* name);

  PairPlacerOptions options_;
  std::unique_ptr<Prepared> target_, source_;
};

} // namespace pcl6d
