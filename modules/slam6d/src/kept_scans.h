// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "agreement.h"
#include "scan_matcher.h"

#include <pcl6d/common/work_sharing.h>

#include <deque>
#include <string>
#include <vector>

namespace pcl6d::slam6d {

/** The scans of a run as far as they are needed: as they were added until there are parameters,
 * then reduced, and, until the scan after them is matched, all points within the range gate.
 * Processes that share the work prepare their own ones and pass on what is reduced; the first
 * has the measured points of all, others those of their own ones. */
class KeptScans {
public:
  /** The options are kept by reference. */
  explicit KeptScans(const Slam6DOptions& options) : options_(options) {}

  void
  setSharing(WorkSharing* sharing)
  {
    sharing_ = sharing;
  }

  /** \return whether this process matches scans, and is asked */
  bool
  isFirst() const
  {
    return !sharing_ || sharing_->isFirst();
  }

  /** \return whether the points of a scan are to be there */
  bool
  isHere(std::size_t place) const
  {
    return isFirst() || sharing_->owns(place);
  }

  void
  add(const Points& points, const std::string& name);

  /** Takes back a scan that was just added and could not be reduced. */
  void
  forget(std::size_t place);

  /** \return whether enough scans wait to be prepared \param[in] has_parameters false: enough to
   * derive these from */
  bool
  isFull(bool has_parameters) const;

  /** \return the parameters that follow from the scans that wait
   * \throws ComputeFailed, RankFailed */
  Slam6DParameters
  derive() const;

  /** Prepares the scans that wait. \param[in,out] scans get their number of reduced points
   * \throws ComputeFailed, RankFailed */
  void
  prepare(const ScanMatcher& matcher,
          const Slam6DParameters& parameters,
          std::vector<ScanResult>& scans);

  /** Drops the measured points of a scan. */
  void
  dropMeasured(std::size_t place)
  {
    measured_[place] = MeasuredScan();
  }

  /** Puts other reduced points in the place of a scan's; what refers to them sees these. */
  void
  replace(std::size_t place, IcpModel reduced)
  {
    reduced_[place] = std::move(reduced);
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

  ReductionOptions
  reduction() const;

  const Slam6DOptions& options_;
  WorkSharing* sharing_ = nullptr;
  std::vector<std::string> names_;
  std::deque<Points> unreduced_;      ///< scans that wait for the parameters
  std::deque<IcpModel> reduced_;      ///< a deque: the matcher refers to its elements
  std::deque<MeasuredScan> measured_; ///< emptied behind the scan before the next
};

} // namespace pcl6d::slam6d
