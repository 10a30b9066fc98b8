// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/registration/pcl/icp6d.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Point-to-plane ICP: drop-in for pcl::IterativeClosestPointWithNormals, ICP6D with
 * Metric::kPlane and its symmetric objective. Missing normals are estimated.
 * \ingroup registration */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class ICP6DWithNormals : public ICP6D<PointSource, PointTarget, Scalar> {
public:
  using Ptr = pcl::shared_ptr<ICP6DWithNormals<PointSource, PointTarget, Scalar>>;
  using ConstPtr =
      pcl::shared_ptr<const ICP6DWithNormals<PointSource, PointTarget, Scalar>>;

  ICP6DWithNormals()
  {
    this->reg_name_ = "ICP6DWithNormals";
    this->setMetric(Metric::kPlane);
  }

  /** \brief Whether the normals of both sides count (IcpOptions::symmetric); false unless
   * set. */
  void
  setUseSymmetricObjective(bool symmetric)
  {
    this->options_.symmetric = symmetric;
  }
  bool
  getUseSymmetricObjective() const
  {
    return this->options_.symmetric;
  }

  /** \brief With the symmetric objective: whether a normal is turned towards its partner's;
   * true unless set. */
  void
  setEnforceSameDirectionNormals(bool enforce)
  {
    this->options_.align_normals = enforce;
  }
  bool
  getEnforceSameDirectionNormals() const
  {
    return this->options_.align_normals;
  }
};

PCL6D_DECLARE_PAIR_INSTANCES(ICP6DWithNormals)
} // namespace pcl6d
