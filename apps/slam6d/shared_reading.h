// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/earlier_runs.h"
#include "slam6d/run_scans.h"

#include <pcl6d/common/work_sharing.h>
#include <pcl6d/slam6d/slam6d.h>

#include <functional>

namespace pcl6d::app {

/** \brief The scans of a run, in their order: read by this process, or each by the one that
 * owns it. */
class SharedReading {
public:
  /** Keeps references. \param[in] earlier the runs that go on or are joined, if so
   * \param[in] ranks null: this process reads all */
  SharedReading(RunScans& scans, const EarlierRuns& earlier, WorkSharing* ranks)
  : scans_(scans), earlier_(earlier), ranks_(ranks)
  {}

  /** Told of each scan; the first process of all, others of their own ones, and of the rest as
   * empty ones. \return false to stop */
  using Take = std::function<bool(std::size_t, Scan)>;

  /** \return false if it was stopped
   * \throws IoFailed a scan cannot be read, or has fewer than 3 finite points */
  bool
  readAll(const Take& take);

  /** \brief Adds a scan that was read. \return how many of its points were not finite */
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
