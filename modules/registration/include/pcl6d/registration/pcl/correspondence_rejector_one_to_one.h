// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/pcl/correspondence_rejector.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Leaves each target point its closest source point, as a drop-in for
 * pcl::registration::CorrespondenceRejectorOneToOne. Of several equally near points the smallest
 * index stays (PCL: any), and the pairs keep their order (PCL: the order of the target's indices).
 * \note Source: T. Zinsser, J. Schmidt, H. Niemann, "A refined ICP algorithm for robust 3-D
 * correspondence estimation", ICIP 2003. \ingroup registration */
class CorrespondenceRejectorOneToOne : public SelectingRejector {
public:
  using Ptr = pcl::shared_ptr<CorrespondenceRejectorOneToOne>;
  using ConstPtr = pcl::shared_ptr<const CorrespondenceRejectorOneToOne>;

  CorrespondenceRejectorOneToOne() : SelectingRejector("CorrespondenceRejectorOneToOne")
  {}

protected:
  pcl::Correspondences
  select(const pcl::Correspondences& original) override;
};

} // namespace pcl6d
