// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/run_result.h>
#include <pcl6d/slam6d/slam6d.h>

#include <pcl/PCLPointCloud2.h>

#include <cstddef>
#include <optional>
#include <string>

namespace pcl6d::app {

/** \brief Treatment of dynamic points (--moving). */
enum class Moving {
  kKeep,  ///< no test for dynamic points
  kLabel, ///< a field `dynamic` in scans/; left out of the map
  kRemove ///< left out of scans/ and of the map
};

/** \throws BadArgument unknown name; the message lists the valid names */
Moving
movingFromName(const std::string& name);

/** \brief Labels or removes dynamic points of scans, and counts them. */
class MovingOutput {
public:
  /** \param[in] slam with tested scans; kept by reference */
  MovingOutput(Moving policy, const Slam6D& slam);

  struct Parted {
    Points standing; ///< [m] one per point of the cloud; not finite for dynamic points
    Points moving;   ///< [m] the dynamic points
  };
  /** \brief Tests all points of a scan. \param[in,out] cloud gets its points labelled, or its
   * dynamic points removed */
  Parted
  apply(std::size_t scan, pcl::PCLPointCloud2& cloud);

  /** \return none if not tested */
  const std::optional<MovingResult>&
  result() const
  {
    return result_;
  }

private:
  Moving policy_;
  const Slam6D& slam_;
  std::optional<MovingResult> result_;
};

} // namespace pcl6d::app
