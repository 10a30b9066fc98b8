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
  ScanParameterOptions parameters; ///< each missing value follows from the scan
  /** unit vectors in the frames of the scans: the sensors' own up, see estimateVertical() */
  Eigen::Vector3d target_up = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d source_up = Eigen::Vector3d::UnitZ();
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Result of PairPlacer. */
struct PairPlacement {
  PlaceResult result; ///< poses of the source on the target
  /** the best pose, matched by every point of both scans; identity without a candidate */
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
};

/** \brief Place recognition between two measured point sets: the compiled core of
 * GlobalRegistration. Each scan is prepared with its own range gate and voxel. A target is
 * prepared once for every source, and a result does not depend on earlier calls.
 * \ingroup global_registration */
class PairPlacer {
public:
  PairPlacer();
  ~PairPlacer();
  PairPlacer(PairPlacer&&) noexcept;
  PairPlacer&
  operator=(PairPlacer&&) noexcept;

  /** \throws BadArgument an invalid option */
  void
  setOptions(const PairPlacerOptions& options);
  const PairPlacerOptions&
  options() const
  {
    return options_;
  }

  /** \brief Finds the pose of the source on the target. Data prepared from an unchanged target
   * or source are reused.
   * \param[in] target, source [m] in the frames of their scanners, which stand at the origins
   * \return never throws on data: kNone with the reason for too few points, or for points too
   * far apart for the voxels */
  PairPlacement
  place(const Points& target, const Points& source);

private:
  struct Prepared;

  /** \return prepared data, computed again if points or options have changed */
  const Prepared&
  prepared(std::unique_ptr<Prepared>& kept,
           const Points& points,
           const Eigen::Vector3d& up,
           const char* name);

  PairPlacerOptions options_;
  std::unique_ptr<Prepared> target_, source_;
};

} // namespace pcl6d
