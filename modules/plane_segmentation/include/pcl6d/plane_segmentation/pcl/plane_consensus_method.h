// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/plane_segmentation/plane_consensus.h>

#include <pcl/sample_consensus/sac.h>

#include <functional>
#include <utility>

namespace PCL6D_EXPORTS pcl6d {

/** \brief findPlaneConsensus() as a sample consensus method of PCL, returned by
 * getMethod() of PlaneSACSegmentation. Complete; keeps its inputs alive.
 * \ingroup plane_segmentation */
template <typename PointT>
class PlaneConsensusMethod : public pcl::SampleConsensus<PointT> {
public:
  using Ptr = pcl::shared_ptr<PlaneConsensusMethod<PointT>>;
  using ModelPtr = typename pcl::SampleConsensusModel<PointT>::Ptr;

  /** \param[in] model of the method \param[in] pack makes the points
   * \param[in] indices into the cloud, per point
   * \param[in] viewpoint [m] towards which the plane's normal shall point */
  PlaneConsensusMethod(const ModelPtr& model,
                       const PlaneConsensusOptions& options,
                       std::function<ConsensusPoints()> pack,
                       const pcl::IndicesConstPtr& indices,
                       const Eigen::Vector3d& viewpoint)
  : pcl::SampleConsensus<PointT>(model, options.max_distance)
  , options_(options)
  , pack_(std::move(pack))
  , indices_(indices)
  , viewpoint_(viewpoint)
  {
    this->setProbability(options.probability);
    this->setMaxIterations(static_cast<int>(options.max_iterations));
  }

  /** \brief Finds the plane. Uses the base class's setters of threshold, probability
   * and iterations, but the options' number of threads.
   * \return whether a plane was found \throws BadArgument an option is invalid */
  bool
  computeModel(int verbosity = 0) override;

  /** \return the plane found, in double */
  const PlaneConsensus&
  result() const
  {
    return result_;
  }

private:
  PlaneConsensusOptions options_;
  std::function<ConsensusPoints()> pack_;
  pcl::IndicesConstPtr indices_;
  Eigen::Vector3d viewpoint_;
  PlaneConsensus result_;
};

} // namespace pcl6d
#include <pcl6d/plane_segmentation/pcl/impl/plane_consensus_method.hpp>
