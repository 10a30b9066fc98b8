// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/other_filter.h"

#include <pcl6d/common/run_result.h>
#include <pcl6d/filters/line_filter.h>
#include <pcl6d/filters/motion_correction.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/slam6d/motion_options.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pcl6d::app {

/** \brief The scans of a folder as they are registered: as they were measured, or with
 * the motion of the scanner during each of them undone (--deskew), and filtered along
 * their lines (--filter). Those of a finished
 * run that goes on are as that run wrote them. */
class RunScans {
public:
  /** Keeps a reference to the folder. */
  explicit RunScans(const ScanFolder& folder) : folder_(folder) {}

  /** \brief From now on the motion is undone. Reads the first scan to be registered, which
   * tells how times are stored. \throws IoFailed poses, stamps or times are missing or broken */
  void
  deskew(MotionInterpolation interpolation);

  /** \brief From now on scans come with the times of their points, so that their motion can be
   * found. Reads the first scan to be registered, which tells how times are stored.
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
   * \throws IoFailed they are missing or broken */
  ScanTimes
  scanTimes(const Scan& scan, std::size_t i) const;

  /** \brief Brings a scan that was read to the pose at its stamp.
   * \throws IoFailed as scanTimes() */
  void
  undoMotion(const MotionWithinScan& motion,
             std::size_t i,
             pcl::PCLPointCloud2& cloud) const;

  /** \brief From now on scans go through filters along their lines (--filter). */
  void
  filterLines(LineFilter filter);

  /** \brief From now on scans go through a filter of a plug-in, in the end. Its result is a
   * scan of its own. */
  void
  filterBy(const OtherFilter& filter);

  /** \brief From now on registered scans lose the points outside the ranges [m] that their
   * run counted. \param[in] gates one per scan that is registered, or none */
  void
  gate(std::vector<std::pair<double, double>> gates);

  const ScanFolder&
  folder() const
  {
    return folder_;
  }

  /** \brief Reads the i-th selected scan. \throws IoFailed as ScanFolder::read(), its
   * times are missing or broken, it has no lines to filter along, or a filter of a plug-in
   * makes no scan of it */
  Scan
  read(std::size_t i);

  /** \return what is done to the scans, for people; a line each */
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
  bool estimates_motion_ = false;
  std::optional<MotionCorrection>
      clock_;                 ///< of estimated motion: the stamps of the scans
  std::optional<Scan> first_; ///< to be registered, if it was read already
  TimeFormat format_;
  LineFilter filter_ = LineFilter::kNone;
  OtherFilter other_filter_;
  std::vector<std::pair<double, double>> gates_;
  std::vector<std::string> descriptions_;
};

} // namespace pcl6d::app
