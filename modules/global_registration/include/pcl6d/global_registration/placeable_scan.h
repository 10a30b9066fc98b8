// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/global_registration/vertical.h>
#include <pcl6d/verification/verified_scan.h>

#include <cstddef>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A scan prepared for place recognition: its vertical, and evenly spaced samples small
 * enough to test many poses. Built once, used for each of its pairs.
 * \ingroup global_registration */
class PlaceableScan {
public:
  /** Points with their normals, a part of the scan's. */
  struct Sample {
    Points points; ///< [m] in the scan's frame
    Normals normals;
  };

  /** Bounding sphere of the test points. */
  struct Ball {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero(); ///< [m] in the scan's frame
    double radius = 0;                                ///< [m]
  };

  /** \param[in] scan kept by reference; its surfaces have normals
   * \param[in] expected_up unit vector in the scan's frame: the sensor's own up
   * \throws BadArgument expected_up is no unit vector */
  explicit PlaceableScan(const VerifiedScan& scan,
                         const Eigen::Vector3d& expected_up = Eigen::Vector3d::UnitZ());

  const VerifiedScan&
  scan() const
  {
    return *scan_;
  }
  const VerticalEstimate&
  vertical() const
  {
    return vertical_;
  }
  /** \return [m] edge of the cells of its plan */
  double
  cell() const
  {
    return cell_;
  }
  /** \return the points that test a pose */
  const Sample&
  evaluated() const
  {
    return evaluated_;
  }
  const Ball&
  ball() const
  {
    return ball_;
  }
  /** \return the points for matching */
  const Sample&
  matched() const
  {
    return matched_;
  }

private:
  const VerifiedScan* scan_;
  VerticalEstimate vertical_;
  double cell_;
  Sample evaluated_, matched_;
  Ball ball_;
};

} // namespace pcl6d
