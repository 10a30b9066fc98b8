// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/input/other_filter.h"

#include <pcl6d/common/run_result.h>
#include <pcl6d/deskew/motion_correction.h>
#include <pcl6d/deskew/motion_options.h>
#include <pcl6d/filters/line_filter.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/slam6d/slam6d.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pcl6d::app {

/** \brief The scans of a folder, prepared for registration: as measured, or deskewed (--deskew),
 * and filtered along their lines (--filter). Scans of a finished, continued run are read as the
 * run wrote them. */
class RunScans {
public:
  /** Keeps a reference to the folder. */
  explicit RunScans(const ScanFolder& folder) : folder_(folder) {}

  /** \brief Enables deskewing. Reads the first scan to be registered, to detect how times are
   * stored.
   * \param[in] paths the motion within each scan, T_world_sensor at times [s] since the stamp, which
   * is among them; where a path is missing or empty, the motion follows from the initial poses
   * \throws IoFailed poses, stamps or times are missing or broken */
  void
  deskew(MotionInterpolation interpolation, std::vector<Trajectory> paths = {});

  /** \brief Tells what tracking found. \param[in] contexts one per scan; empty: not tracked */
  void
  setDriveContexts(std::vector<DriveContext> contexts)
  {
    contexts_ = std::move(contexts);
  }

  /** \brief Takes what tracking tells of a scan (Slam6D::addScan()). */
  DriveContext
  takeDriveContext(std::size_t i)
  {
    return i < contexts_.size() ? std::exchange(contexts_[i], {}) : DriveContext();
  }

  /** \brief Enables reading of the times of points, to estimate the motion within scans. Reads the
   * first scan to be registered, to detect how times are stored.
   * \throws IoFailed times are missing or broken */
  void
  estimateMotion();

  /** \return whether estimateMotion() was called */
  bool
  estimatesMotion() const
  {
    return estimates_motion_;
  }

  /** \return the times of the points of a scan that was read
   * \throws IoFailed times are missing or broken */
  ScanTimes
  scanTimes(const Scan& scan, std::size_t i) const;

  /** \brief Deskews a scan to the pose at its stamp.
   * \throws IoFailed as scanTimes() */
  void
  undoMotion(const MotionWithinScan& motion,
             std::size_t i,
             pcl::PCLPointCloud2& cloud) const;

  /** \brief Enables filters along the lines of scans (--filter). */
  void
  filterLines(LineFilter filter);

  /** \brief Enables a filter of a plug-in, applied last. Its result is a separate scan. */
  void
  filterBy(const OtherFilter& filter);

  /** \brief Enables removal of points of registered scans outside the range gates [m] of their
   * runs. \param[in] gates one per registered scan, or empty */
  void
  gate(std::vector<std::pair<double, double>> gates);

  const ScanFolder&
  folder() const
  {
    return folder_;
  }

  /** \brief Reads the i-th selected scan. \throws IoFailed as ScanFolder::read(); its times are
   * missing or broken; it has no lines to filter along; or a filter of a plug-in returns no valid
   * scan */
  Scan
  read(std::size_t i);

  /** \return the processing of the scans, for people; a line each */
  const std::vector<std::string>&
  descriptions() const
  {
    return descriptions_;
  }

private:
  void
  gateRegistered(Scan& scan, std::size_t i) const;
  void
  undoMotion(Scan& scan, std::size_t i) const;
  void
  filterByOther(Scan& scan, std::size_t i) const;
  void
  requireLines(const Scan& scan, std::size_t i) const;
  FieldValues
  timesOf(const pcl::PCLPointCloud2& cloud, std::size_t i) const;
  ScanTimes
  scanTimes(const pcl::PCLPointCloud2& cloud, std::size_t i) const;

  const ScanFolder& folder_;
  std::optional<MotionCorrection> correction_; ///< along the initial poses
  std::vector<Trajectory> paths_;              ///< see deskew()
  std::vector<DriveContext> contexts_;         ///< by tracking
  bool estimates_motion_ = false;
  std::optional<MotionCorrection>
      clock_;                 ///< of estimated motion: the stamps of the scans
  std::optional<Scan> first_; ///< to be registered, if already read
  TimeFormat format_;
  LineFilter filter_ = LineFilter::kNone;
  OtherFilter other_filter_;
  std::vector<std::pair<double, double>> gates_;
  std::vector<std::string> descriptions_;
};

} // namespace pcl6d::app
