// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/require_indices.h>
#include <pcl6d/plane_segmentation/pcl/plane_sac_segmentation.h>

#include <pcl/sample_consensus/method_types.h>
#include <pcl/sample_consensus/model_types.h>

#include <algorithm>
#include <ctime>

namespace PCL6D_EXPORTS pcl6d {

/** \return the criterion of a PCL method \throws BadArgument not a method of PCL */
inline ConsensusCriterion
consensusCriterionOf(int method_type)
{
  switch (method_type) {
  case pcl::SAC_RANSAC:
  case pcl::SAC_RRANSAC:
  case pcl::SAC_PROSAC:
    return ConsensusCriterion::kMostPoints;
  case pcl::SAC_MSAC:
  case pcl::SAC_RMSAC:
  case pcl::SAC_MLESAC:
    return ConsensusCriterion::kTruncatedSquares;
  case pcl::SAC_LMEDS:
    return ConsensusCriterion::kLeastMedian;
  default:
    require(false,
            "method type",
            method_type,
            "one of SAC_RANSAC, SAC_LMEDS, SAC_MSAC, SAC_RRANSAC, SAC_RMSAC, "
            "SAC_MLESAC, SAC_PROSAC");
    return {};
  }
}

template <typename Base, typename PointT>
bool
PlaneSAC<Base, PointT>::hasModel(int model_type) const
{
  return model_type == pcl::SACMODEL_PLANE ||
         model_type == pcl::SACMODEL_PERPENDICULAR_PLANE ||
         model_type == pcl::SACMODEL_PARALLEL_PLANE;
}

template <typename Base, typename PointT>
std::string
PlaneSAC<Base, PointT>::modelNames() const
{
  return "SACMODEL_PLANE, SACMODEL_PERPENDICULAR_PLANE or SACMODEL_PARALLEL_PLANE";
}

template <typename Base, typename PointT>
void
PlaneSAC<Base, PointT>::checkSettings() const
{
  require(this->input_ != nullptr, "input cloud", "null", "set");
  require(
      hasModel(this->getModelType()), "model type", this->getModelType(), modelNames());
  require(this->threshold_ > 0 && std::isfinite(this->threshold_),
          "distance threshold",
          this->threshold_,
          "> 0 and finite");
  require(this->max_iterations_ >= -1, "iterations", this->max_iterations_, ">= -1");
  require(this->getEpsAngle() >= 0 && std::isfinite(this->getEpsAngle()),
          "eps angle",
          this->getEpsAngle(),
          ">= 0 and finite");
  require(this->samples_radius_ >= 0 && std::isfinite(this->samples_radius_),
          "distance of samples",
          this->samples_radius_,
          ">= 0 and finite");
  if (this->samples_radius_ > 0)
    require(this->samples_radius_search_ != nullptr &&
                this->samples_radius_search_->getInputCloud() == this->input_,
            "search for samples",
            this->samples_radius_search_ ? "that of another cloud" : "null",
            "one that holds the input cloud");
}

template <typename Base, typename PointT>
std::optional<DirectionLimit>
PlaneSAC<Base, PointT>::directionLimit() const
{
  constexpr double kRightAngle = 1.5707963267948966;
  if (!(this->getEpsAngle() > 0) || this->getModelType() == pcl::SACMODEL_PLANE ||
      this->getModelType() == pcl::SACMODEL_NORMAL_PLANE)
    return {};
  const double angle = std::min<double>(this->getEpsAngle(), kRightAngle);
  DirectionLimit limit;
  limit.axis = this->getAxis().template cast<double>();
  limit.least = 0;
  limit.most = angle;
  if (this->getModelType() == pcl::SACMODEL_PARALLEL_PLANE) {
    limit.least = kRightAngle - angle;
    limit.most = kRightAngle;
  }
  return limit;
}

template <typename Base, typename PointT>
std::function<void(std::uint32_t, std::vector<std::uint32_t>&)>
PlaneSAC<Base, PointT>::neighbours() const
{
  if (!(this->samples_radius_ > 0))
    return {};
  const auto cloud = this->input_;
  const pcl::IndicesConstPtr indices = this->indices_;
  const auto search = this->samples_radius_search_;
  const double radius = this->samples_radius_;
  // Position of each cloud point in the indices; its last position, if it occurs twice.
  std::vector<std::int64_t> places(cloud->size(), -1);
  for (std::size_t i = 0; i < indices->size(); ++i)
    places[static_cast<std::size_t>((*indices)[i])] = static_cast<std::int64_t>(i);
  return [=](std::uint32_t place, std::vector<std::uint32_t>& near) {
    pcl::Indices found;
    std::vector<float> squares;
    const auto index = static_cast<std::size_t>((*indices)[place]);
    search->radiusSearch((*cloud)[index], radius, found, squares);
    near.clear();
    for (const auto other : found)
      if (places[static_cast<std::size_t>(other)] >= 0)
        near.push_back(
            static_cast<std::uint32_t>(places[static_cast<std::size_t>(other)]));
  };
}

template <typename Base, typename PointT>
PlaneConsensusOptions
PlaneSAC<Base, PointT>::consensusOptions() const
{
  constexpr std::size_t kPclsIterations = 1000; // of pcl::SampleConsensus
  constexpr std::uint64_t kPclsSeed = 12345;    // arbitrary
  PlaneConsensusOptions options;
  options.max_distance = this->threshold_;
  options.criterion = consensusCriterionOf(this->method_type_);
  options.probability = this->probability_;
  options.max_iterations =
      this->max_iterations_ < 0
          ? kPclsIterations
          : std::max<std::size_t>(1, static_cast<std::size_t>(this->max_iterations_));
  options.direction = directionLimit();
  options.refine = this->optimize_coefficients_;
  options.seed =
      draws_by_time_ ? static_cast<std::uint64_t>(std::time(nullptr)) : kPclsSeed;
  options.num_threads =
      this->threads_ < 0 ? 1 : static_cast<unsigned int>(this->threads_);
  options.neighbours = neighbours();
  options.validate();
  return options;
}

template <typename Base, typename PointT>
std::function<ConsensusPoints()>
PlaneSAC<Base, PointT>::packer() const
{
  return [cloud = this->input_, indices = pcl::IndicesConstPtr(this->indices_)] {
    ConsensusPoints points(indices->size());
    for (const auto index : *indices) {
      const PointT& p = (*cloud)[static_cast<std::size_t>(index)];
      points.add(p.x, p.y, p.z);
    }
    return points;
  };
}

/** \brief Gives PCL's model the distances of its inliers, from which its
 * computeVariance() computes the spread. */
template <typename Base, typename PointT>
void
PlaneSAC<Base, PointT>::keepDistances(const pcl::Indices& inliers)
{
  struct Access : public pcl::SampleConsensusModel<PointT> {
    static std::vector<double>&
    distances(pcl::SampleConsensusModel<PointT>& model)
    {
      return model.*(&Access::error_sqr_dists_);
    }
  };
  std::vector<double>& distances = Access::distances(*this->getModel());
  distances.resize(inliers.size());
  const double offset = result_.offset;
  for (std::size_t i = 0; i < inliers.size(); ++i) {
    const auto& p = (*this->input_)[static_cast<std::size_t>(inliers[i])];
    distances[i] = std::abs(result_.normal.x() * static_cast<double>(p.x) +
                            result_.normal.y() * static_cast<double>(p.y) +
                            result_.normal.z() * static_cast<double>(p.z) - offset);
  }
}

template <typename Base, typename PointT>
void
PlaneSAC<Base, PointT>::segment(pcl::PointIndices& inliers,
                                pcl::ModelCoefficients& coefficients)
{
  checkSettings();
  inliers.header = coefficients.header = this->input_->header;
  inliers.indices.clear();
  coefficients.values.clear();
  result_ = {};
  if (!pcl::PCLBase<PointT>::initCompute())
    return;
  requireIndices(*this->indices_, this->input_->size());
  const PlaneConsensusOptions options = consensusOptions();
  if (!this->initSACModel(this->getModelType()))
    return;
  const auto method = pcl::make_shared<PlaneConsensusMethod<PointT>>(
      this->getModel(),
      options,
      packer(),
      this->indices_,
      this->input_->sensor_origin_.template head<3>().template cast<double>());
  method->setNumberOfThreads(this->threads_);
  this->sac_ = method;
  if (this->samples_radius_ > 0)
    this->getModel()->setSamplesMaxDist(this->samples_radius_,
                                        this->samples_radius_search_);
  const bool found = method->computeModel();
  result_ = method->result();
  if (found) {
    Eigen::VectorXf plane;
    method->getModelCoefficients(plane);
    method->getInliers(inliers.indices);
    coefficients.values.assign(plane.data(), plane.data() + plane.size());
    keepDistances(inliers.indices);
  }
  else
    PCL_ERROR("[pcl6d::%s::segment] Error segmenting the model! No solution found.\n",
              this->getClassName().c_str());
  pcl::PCLBase<PointT>::deinitCompute();
}

template <typename PointT, typename PointNT>
bool
PlaneSACSegmentationFromNormals<PointT, PointNT>::hasModel(int model_type) const
{
  return Shared::hasModel(model_type) || model_type == pcl::SACMODEL_NORMAL_PLANE ||
         model_type == pcl::SACMODEL_NORMAL_PARALLEL_PLANE;
}

template <typename PointT, typename PointNT>
std::string
PlaneSACSegmentationFromNormals<PointT, PointNT>::modelNames() const
{
  return "SACMODEL_NORMAL_PLANE, SACMODEL_NORMAL_PARALLEL_PLANE, " +
         Shared::modelNames();
}

template <typename PointT, typename PointNT>
void
PlaneSACSegmentationFromNormals<PointT, PointNT>::checkSettings() const
{
  Shared::checkSettings();
  require(this->normals_ != nullptr, "input normals", "null", "set");
  require(this->normals_->size() == this->input_->size(),
          "number of normals",
          this->normals_->size(),
          "that of the points, " + std::to_string(this->input_->size()));
  require(this->distance_weight_ >= 0 && this->distance_weight_ <= 1,
          "normal distance weight",
          this->distance_weight_,
          "in [0, 1]");
  if (this->getModelType() == pcl::SACMODEL_NORMAL_PARALLEL_PLANE)
    require(this->distance_from_origin_ == 0,
            "distance from the origin",
            this->distance_from_origin_,
            "0, as PCL has no tolerance for it");
}

template <typename PointT, typename PointNT>
std::function<ConsensusPoints()>
PlaneSACSegmentationFromNormals<PointT, PointNT>::packer() const
{
  if (Shared::hasModel(this->getModelType()))
    return Shared::packer();
  return [cloud = this->input_,
          normals = this->normals_,
          indices = pcl::IndicesConstPtr(this->indices_),
          weight = this->distance_weight_] {
    ConsensusPoints points(indices->size(), true);
    for (const auto index : *indices) {
      const PointT& p = (*cloud)[static_cast<std::size_t>(index)];
      const PointNT& n = (*normals)[static_cast<std::size_t>(index)];
      const double flat = 1 - std::min(1.0, std::max<double>(n.curvature, 0));
      points.add({p.x, p.y, p.z},
                 {n.normal_x, n.normal_y, n.normal_z},
                 static_cast<float>(weight * flat));
    }
    return points;
  };
}

} // namespace pcl6d
