// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "matching/agreement.h"
#include "matching/scan_matcher.h"

#include <pcl6d/common/progress.h>
#include <pcl6d/common/work_sharing.h>
#include <pcl6d/slam6d/slam6d.h>

#include <deque>
#include <string>
#include <vector>

namespace pcl6d::slam6d {

/** The points of a run's scans. Points are kept as added until the parameters are derived, then
 * reduced; all points within the range gate are kept until the next scan is matched. Processes
 * that share the work prepare their own scans and exchange the reduced points. The first process
 * keeps the measured points of every scan, the remaining processes only of their own scans. */
class KeptScans {
public:
  /** The options are kept by reference. */
  explicit KeptScans(const Slam6DOptions& options) : options_(options) {}

  void
  setSharing(WorkSharing* sharing)
  {
    sharing_ = sharing;
  }

  /** \return whether this process matches scans and answers requests */
  bool
  isFirst() const
  {
    return !sharing_ || sharing_->isFirst();
  }

  /** \return whether this process needs the points of a scan */
  bool
  isHere(std::size_t place) const
  {
    return isFirst() || sharing_->owns(place);
  }

  /** \param[in] drive see Slam6D::addScan() */
  void
  add(const Points& points, const std::string& name, const DriveContext& drive);

  /** Removes the latest scan, whose reduction failed. */
  void
  forget(std::size_t place);

  /** \return whether enough scans wait for preparation \param[in] has_parameters false: enough to
   * derive parameters */
  bool
  isFull(bool has_parameters) const;

  /** \return the parameters derived from the waiting scans
   * \throws ComputeFailed, RankFailed */
  Slam6DParameters
  derive(const Slam6DOptions& options) const;

  /** Prepares the waiting scans. After an exception of the report, the next call continues.
   * \param[in] report called after each scan, unless processes share the work; may be null
   * \param[in,out] scans get their number of reduced points
   * \throws ComputeFailed, RankFailed */
  void
  prepare(const ScanMatcher& matcher,
          const Slam6DParameters& parameters,
          const ProgressCallback& report,
          std::vector<ScanResult>& scans);

  /** Drops the measured points of a scan. */
  void
  dropMeasured(std::size_t place)
  {
    measured_[place] = MeasuredScan();
  }

  /** Replaces the reduced points of a scan. References to the model stay valid and see the new
   * points. */
  void
  replace(std::size_t place, IcpModel reduced)
  {
    reduced_[place] = std::move(reduced);
    ++revision_;
  }

  /** \return a number changed by each replace() */
  std::size_t
  revision() const
  {
    return revision_;
  }

  /** \return whether surfaces measured the motion from the scan before (Slam6D::addScan()) */
  bool
  isStepMeasured(std::size_t place) const
  {
    return are_steps_measured_[place];
  }

  /** \return DriveContext::frame of each scan */
  const std::vector<Eigen::Matrix<double, 6, 6>>&
  frames() const
  {
    return frames_;
  }

  const std::vector<std::string>&
  names() const
  {
    return names_;
  }
  const std::deque<IcpModel>&
  reduced() const
  {
    return reduced_;
  }
  const std::deque<MeasuredScan>&
  measured() const
  {
    return measured_;
  }

private:
  void
  prepareShared(const ScanMatcher& matcher,
                const Slam6DParameters& parameters,
                std::vector<ScanResult>& scans);
  void
  keep(IcpModel reduced, Points gated, std::vector<ScanResult>& scans);

  struct Waiting {
    Points points;
    std::vector<PosedPoints> submap; ///< DriveContext
  };

  /** \return the reduced points of a waiting scan and its submap \param[in] k its number among the
   * waiting scans */
  Points
  reduce(const Points& gated, std::size_t k, const Slam6DParameters& parameters) const;

  const Slam6DOptions& options_;
  WorkSharing* sharing_ = nullptr;
  std::size_t revision_ = 0;
  std::vector<std::string> names_;
  std::vector<bool> are_steps_measured_;
  std::vector<Eigen::Matrix<double, 6, 6>> frames_;
  std::deque<Waiting> unreduced_; ///< scans without parameters yet
  std::deque<IcpModel> reduced_;  ///< a deque: the matcher keeps references to elements
  std::deque<MeasuredScan> measured_; ///< emptied behind the scan before the next
};

} // namespace pcl6d::slam6d
