// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/run_result.h>
#include <pcl6d/slam6d/slam6d.h>

#include <pcl/PCLPointCloud2.h>

#include <cstddef>
#include <optional>
#include <string>

namespace pcl6d::app {

/** \brief What becomes of points that moved (--moving). */
enum class Moving {
  kKeep,  ///< nobody asks what moved
  kLabel, ///< a field `dynamic` in scans/; they are not in the map
  kRemove ///< they are in neither
};

/** \throws BadArgument no such name; the message lists all */
Moving
movingFromName(const std::string& name);

/** \brief Labels or removes the points of scans that moved, and counts them. */
class MovingOutput {
public:
  /** \param[in] slam whose scans were judged; kept by reference */
  MovingOutput(Moving policy, const Slam6D& slam);

  struct Parted {
    Points standing; ///< [m] one per point of the cloud; not finite where it moved
    Points moving;   ///< [m] those that moved
  };
  /** \brief Judges all points of a scan. \param[in,out] cloud with its points labelled, or without
   * those that moved */
  Parted
  apply(std::size_t scan, pcl::PCLPointCloud2& cloud);

  /** \return none if nobody asked */
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
