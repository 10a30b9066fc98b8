// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/icp_model.h>
#include <pcl6d/visibility/ray_image.h>

#include <memory>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A scan made ready to be verified against others: its surfaces and its rays.
 * Made once, used for all of its links. \ingroup verification */
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

  /** \brief A scan that another process has made ready: all but its surfaces is to be
   * unpacked (packing.h). \param[in] surfaces kept by reference */
  explicit VerifiedScan(const IcpModel& surfaces) : surfaces_(&surfaces) {}

  template <typename Archive>
  friend void
  packFields(Archive& archive, VerifiedScan& scan)
  {
    archive(scan.voxel_, scan.rays_, scan.self_contradiction_, scan.patches_);
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
  /** \return the share of its own points that its rays contradict */
  double
  selfContradiction() const
  {
    return self_contradiction_;
  }
  /** \return the number of its patches of surface: what others can confirm or contradict */
  std::size_t
  patches() const
  {
    return patches_;
  }
  /** \return whether its rays say nothing: they contradict its own points, as of merged
   * scans or after motion during the scan, or it has too few patches */
  bool
  abstains() const;
  /** \return whether it has too few patches of surface to be verified by anything */
  bool
  isTooSmall() const;

private:
  const IcpModel* surfaces_ = nullptr;
  double voxel_ = 0;
  RayImage rays_;
  double self_contradiction_ = 0;
  std::size_t patches_ = 0;
};

} // namespace pcl6d
