// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/input/earlier_runs.h"
#include "slam6d/input/run_scans.h"

#include <pcl6d/common/work_sharing.h>
#include <pcl6d/slam6d/slam6d.h>

#include <functional>

namespace pcl6d::app {

/** \brief Reads the scans of a run in order, in this process, or each scan in its owner. */
class SharedReading {
public:
  /** Keeps references. \param[in] earlier the continued or joined runs, if any
   * \param[in] ranks null: this process reads all scans */
  SharedReading(RunScans& scans, const EarlierRuns& earlier, WorkSharing* ranks)
  : scans_(scans), earlier_(earlier), ranks_(ranks)
  {}

  /** Called for each scan. The first process gets every scan with points; the remaining processes
   * get only their own scans with points, and the rest empty. \return false to stop */
  using Take = std::function<bool(std::size_t, Scan)>;

  /** \return false if stopped
   * \throws IoFailed a scan cannot be read, or has fewer than 3 finite points */
  bool
  readAll(const Take& take);

  /** \brief Adds a scan that was read. \return the number of its non-finite points */
  std::size_t
  add(std::size_t i, const Scan& scan, Slam6D& slam) const;

private:
  Scan
  read(std::size_t i);
  bool
  readAhead(const Take& take);
  bool
  readTogether(const Take& take);

  RunScans& scans_;
  const EarlierRuns& earlier_;
  WorkSharing* ranks_;
};

} // namespace pcl6d::app
