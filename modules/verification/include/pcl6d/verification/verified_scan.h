// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/icp_model.h>
#include <pcl6d/visibility/ray_image.h>

#include <memory>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A scan prepared for verification: its surfaces and its rays. Prepared once for all links
 * of the scan. \ingroup verification */
class VerifiedScan {
public:
  VerifiedScan() = default;

  /** \param[in] measured all points of the scan within the range gate, in its frame [m]
   * \param[in] surfaces the reduced points with normals; kept by reference
   * \param[in] voxel [m] of their reduction; > 0
   * \param[in] origin [m] of its rays, in its frame
   * \throws BadArgument the surfaces have no normals, or voxel or origin are not finite */
  VerifiedScan(const Points& measured,
               const IcpModel& surfaces,
               double voxel,
               const Eigen::Vector3f& origin = Eigen::Vector3f::Zero());

  /** \brief A scan prepared by another process: all members except its surfaces are to be unpacked
   * (packing.h). \param[in] surfaces kept by reference */
  explicit VerifiedScan(const IcpModel& surfaces) : surfaces_(&surfaces) {}

  template <typename Archive>
  friend void
  packFields(Archive& archive, VerifiedScan& scan)
  {
    archive(scan.voxel_, scan.rays_, scan.self_contradiction_, scan.patches_);
    archive(scan.is_off_centre_);
  }

  const IcpModel&
  surfaces() const
  {
    return *surfaces_;
  }
  const RayImage&
  rays() const
  {
    return rays_;
  }
  double
  voxel() const
  {
    return voxel_;
  }
  /** \return [m] standard deviation of a measured point across its surface */
  double
  noise() const
  {
    return rays_.noise();
  }
  /** \return the share of the scan's own points contradicted by its rays */
  double
  selfContradiction() const
  {
    return self_contradiction_;
  }
  /** \return the number of surface patches, which scans can confirm or contradict */
  std::size_t
  patches() const
  {
    return patches_;
  }
  /** \return whether the origin cannot be the scanner's position, e.g. in cut-outs in a common
   * frame: the scan then has no rays (isPlausibleOrigin()) */
  bool
  isOffCentre() const
  {
    return is_off_centre_;
  }
  /** \return whether the rays are unusable: they contradict the scan's own points, e.g. in merged
   * scans or after motion during the scan; the origin is not the scanner; or the scan has too few
   * patches */
  bool
  abstains() const;
  /** \return whether the scan has too few surface patches to be verified */
  bool
  isTooSmall() const;

private:
  const IcpModel* surfaces_ = nullptr;
  double voxel_ = 0;
  RayImage rays_;
  double self_contradiction_ = 0;
  std::size_t patches_ = 0;
  bool is_off_centre_ = false;
};

} // namespace pcl6d
