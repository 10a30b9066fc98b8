// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/common/export.h>
#include <pcl6d/filters/line_growth.h>
#include <pcl6d/registration/icp.h>
#include <pcl6d/registration/pcl/correspondence_estimation.h>
#include <pcl6d/registration/pcl/sums_estimation.h>
#include <pcl6d/registration/pcl/transformation_estimation_scale_quaternion.h>
#include <pcl6d/search/pcl/core_search.h>

#include <pcl/common/transforms.h>
#include <pcl/conversions.h>
#include <pcl/registration/correspondence_rejection.h>
#include <pcl/registration/registration.h>
#include <pcl/registration/transformation_estimation_svd_scale.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <utility>

/** \file
 * Adapters from PCL's plug-in classes of a registration to hooks of the core. */
namespace PCL6D_EXPORTS pcl6d {
namespace registration {

using Rejector =
    std::function<std::vector<IcpPair>(const Eigen::Isometry3d&, std::vector<IcpPair>)>;

/** \return one rejector that applies several in turn */
Rejector
inTurn(std::vector<Rejector> rejectors);

/** \return a rejector that leaves mutually closest pairs
 * \param[in] target is kept by reference */
Rejector
reciprocal(const Points& source, const Points& target, unsigned int num_threads);

/** \throws BadArgument the pointer is null */
template <typename Pointer>
void
requireGiven(const Pointer& pointer, const std::string& name)
{
  if (!pointer)
    throw BadArgument("ICP6D: " + name + " is null");
}

/** \return the given normals, or estimated normals if each given normal has zero length
 * \param[in] tree over the points; null: made here */
Normals
givenOrEstimated(Normals given,
                 const Points& points,
                 const PointTree* tree,
                 const ScanNormals& settings,
                 const IcpOptions& options);

template <typename PointT>
pcl::Indices
allOf(const pcl::PointCloud<PointT>& cloud)
{
  pcl::Indices all(cloud.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/** \return the normals of the chosen points of a cloud; `points`: their coordinates */
template <typename PointT>
Normals
normalsOf(const pcl::PointCloud<PointT>& cloud,
          const pcl::Indices& indices,
          const Points& points,
          const PointTree* tree,
          const ScanNormals& settings,
          const IcpOptions& options)
{
  Normals given;
  if constexpr (pcl::traits::has_normal<PointT>::value) {
    given.reserve(indices.size());
    for (const auto index : indices)
      given.emplace_back(cloud[index].getNormalVector3fMap());
  }
  return givenOrEstimated(std::move(given), points, tree, settings, options);
}

/** \return the place of each point of a cloud among the searched points, -1: not searched; empty if
 * every point is searched \param[in] searched null: every point */
std::vector<int>
placesIn(const pcl::IndicesConstPtr& searched, std::size_t cloud_size);

/** \return the indices of the finite points */
template <typename PointT>
pcl::IndicesPtr
finiteOf(const pcl::PointCloud<PointT>& cloud)
{
  const pcl::IndicesPtr finite(new pcl::Indices);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (cloud[i].getVector3fMap().allFinite())
      finite->push_back(static_cast<int>(i));
  return finite;
}

/** \return the search of any PCL class, with results as places among the searched points */
template <typename PointT>
std::function<Neighbour(const Eigen::Vector3f&, float)>
searchOf(const typename pcl::search::KdTree<PointT>::Ptr& tree)
{
  const auto place = placesIn(tree->getIndices(), tree->getInputCloud()->size());
  return
      [tree, place](const Eigen::Vector3f& query, float max_distance_sq) -> Neighbour {
        if (!query.allFinite() || tree->getInputCloud()->empty())
          return {};
        PointT point;
        point.getVector3fMap() = query;
        pcl::Indices index(1, -1);
        std::vector<float> distance_sq(1);
        if (tree->nearestKSearch(point, 1, index, distance_sq) < 1 ||
            !(distance_sq[0] < max_distance_sq))
          return {};
        return {place.empty() ? index[0] : place.at(index[0]), distance_sq[0]};
      };
}

/** \return the search for several points, nearest first */
template <typename PointT>
std::function<std::vector<Neighbour>(const Eigen::Vector3f&, std::size_t)>
searchOfSeveral(const typename pcl::search::KdTree<PointT>::Ptr& tree)
{
  const auto place = placesIn(tree->getIndices(), tree->getInputCloud()->size());
  return [tree, place](const Eigen::Vector3f& query, std::size_t k) {
    std::vector<Neighbour> found;
    if (!query.allFinite() || tree->getInputCloud()->empty())
      return found;
    PointT point;
    point.getVector3fMap() = query;
    pcl::Indices index;
    std::vector<float> distance_sq;
    const int count =
        tree->nearestKSearch(point, static_cast<int>(k), index, distance_sq);
    for (int i = 0; i < count; ++i)
      found.push_back({place.empty() ? index[i] : place.at(index[i]), distance_sq[i]});
    std::sort(found.begin(), found.end());
    return found;
  };
}

/** \return whether an estimation includes a scale, of PCL or pcl6d */
template <typename PointSource, typename PointTarget, typename Scalar>
bool
hasScale(
    const pcl::registration::TransformationEstimation<PointSource, PointTarget, Scalar>&
        estimation)
{
  using Pcl = pcl::registration::
      TransformationEstimationSVDScale<PointSource, PointTarget, Scalar>;
  using Ours =
      TransformationEstimationScaleQuaternion<PointSource, PointTarget, Scalar>;
  return dynamic_cast<const Pcl*>(&estimation) ||
         dynamic_cast<const Ours*>(&estimation);
}

/** \throws BadArgument the matrix of an estimation is finite, but no motion */
void
requireMotion(const Eigen::Matrix4d& matrix);

/** \return whether icp() itself implements an estimation */
template <typename PointSource,
          typename PointTarget,
          typename Scalar,
          typename Estimation>
bool
isOurs(const Estimation& estimation)
{
  if constexpr (pcl::traits::has_normal<PointTarget>::value)
    if (dynamic_cast<const PlaneEstimation<PointSource, PointTarget, Scalar>*>(
            &estimation))
      return true;
  return dynamic_cast<const SumsEstimation<PointSource, PointTarget, Scalar>*>(
      &estimation);
}

/** \brief Calls PCL's classes with the source moved to a pose. */
template <typename PointSource, typename PointTarget, typename Scalar>
class PclAdapter
: public std::enable_shared_from_this<PclAdapter<PointSource, PointTarget, Scalar>> {
public:
  using Registration = pcl::Registration<PointSource, PointTarget, Scalar>;
  using SourceCloud = pcl::PointCloud<PointSource>;
  using TargetCloud = pcl::PointCloud<PointTarget>;

  /** \param[in] origin of the core's coordinates [m] */
  PclAdapter(const typename SourceCloud::ConstPtr& source,
             const pcl::IndicesConstPtr& indices,
             const typename TargetCloud::ConstPtr& target,
             const typename pcl::search::KdTree<PointTarget>::Ptr& tree,
             const Eigen::Vector3d& origin)
  : source_(new SourceCloud(*source, *indices))
  , finite_(finiteOf(*source_))
  , target_(target)
  , tree_(tree)
  , origin_(origin)
  , place_(placesIn(tree->getIndices(), target->size()))
  {}

  std::function<std::vector<IcpPair>(const Eigen::Isometry3d&, double)>
  finder(const typename Registration::CorrespondenceEstimationPtr& estimation,
         bool reciprocal)
  {
    if constexpr (pcl::traits::has_normal<PointTarget>::value)
      if (estimation->requiresTargetNormals())
        estimation->setTargetNormals(blob(*target_));
    return [self = this->shared_from_this(), estimation, reciprocal](
               const Eigen::Isometry3d& T, double limit) {
      self->moveTo(T);
      estimation->setInputTarget(self->target_);
      estimation->setSearchMethodTarget(self->tree_, true);
      estimation->setInputSource(self->moved_);
      if (self->finite_->size() < self->moved_->size()) // PCL's own search NaN, too
        estimation->setIndicesSource(self->finite_);
      if constexpr (pcl::traits::has_normal<PointSource>::value)
        if (estimation->requiresSourceNormals())
          estimation->setSourceNormals(self->blob(*self->moved_));
      pcl::Correspondences found;
      if (reciprocal)
        estimation->determineReciprocalCorrespondences(found, limit);
      else
        estimation->determineCorrespondences(found, limit);
      return self->toPairs(found);
    };
  }

  Rejector
  rejector(const typename Registration::CorrespondenceRejectorPtr& rejector)
  {
    if (rejector->requiresTargetPoints())
      rejector->setTargetPoints(blob(*target_));
    if constexpr (pcl::traits::has_normal<PointTarget>::value)
      if (rejector->requiresTargetNormals())
        rejector->setTargetNormals(blob(*target_));
    return [self = this->shared_from_this(),
            rejector](const Eigen::Isometry3d& T, const std::vector<IcpPair>& pairs) {
      self->moveTo(T);
      if (rejector->requiresSourcePoints())
        rejector->setSourcePoints(self->blob(*self->moved_));
      if constexpr (pcl::traits::has_normal<PointSource>::value)
        if (rejector->requiresSourceNormals())
          rejector->setSourceNormals(self->blob(*self->moved_));
      rejector->setInputCorrespondences(
          pcl::make_shared<const pcl::Correspondences>(self->toPcl(pairs)));
      pcl::Correspondences kept;
      rejector->getCorrespondences(kept);
      return self->toPairs(kept);
    };
  }

  std::function<RigidEstimate(const Eigen::Isometry3d&, const std::vector<IcpPair>&)>
  minimiser(const typename Registration::TransformationEstimationPtr& estimation)
  {
    return [self = this->shared_from_this(),
            estimation](const Eigen::Isometry3d& T, const std::vector<IcpPair>& pairs) {
      self->moveTo(T);
      // On errors, several estimations of PCL print a message and leave the motion unchanged.
      typename Registration::Matrix4 motion =
          Registration::Matrix4::Constant(std::numeric_limits<Scalar>::quiet_NaN());
      estimation->estimateRigidTransformation(
          *self->moved_, *self->target_, self->toPcl(pairs), motion);
      RigidEstimate step{Status::kOk, Eigen::Isometry3d::Identity()};
      step.transform.matrix() = motion.template cast<double>();
      requireMotion(step.transform.matrix());
      step.transform.translate(self->origin_);
      step.transform.pretranslate(-self->origin_);
      return step;
    };
  }

private:
  /** Moves the source to a pose of the core. */
  void
  moveTo(const Eigen::Isometry3d& T)
  {
    Eigen::Isometry3d T_target = T;
    T_target.pretranslate(origin_);
    moved_.reset(new SourceCloud);
    if constexpr (pcl::traits::has_normal<PointSource>::value)
      pcl::transformPointCloudWithNormals(*source_, *moved_, T_target.matrix());
    else
      pcl::transformPointCloud(*source_, *moved_, T_target.matrix());
  }

  template <typename PointT>
  static pcl::PCLPointCloud2::Ptr
  blob(const pcl::PointCloud<PointT>& cloud)
  {
    const pcl::PCLPointCloud2::Ptr blob(new pcl::PCLPointCloud2);
    pcl::toPCLPointCloud2(cloud, *blob);
    return blob;
  }

  pcl::Correspondences
  toPcl(const std::vector<IcpPair>& pairs) const
  {
    const auto searched = tree_->getIndices();
    pcl::Correspondences found;
    found.reserve(pairs.size());
    for (const auto& pair : pairs)
      found.emplace_back(pair.source,
                         searched ? (*searched)[pair.target] : pair.target,
                         pair.distance_sq);
    return found;
  }

  /** Pairs with points that are not searched are left out. */
  std::vector<IcpPair>
  toPairs(const pcl::Correspondences& found) const
  {
    std::vector<IcpPair> pairs;
    pairs.reserve(found.size());
    for (const auto& pair : found) {
      const int target =
          place_.empty() ? pair.index_match : place_.at(pair.index_match);
      if (pair.index_query >= 0 && target >= 0)
        pairs.push_back({pair.index_query, target, pair.distance});
    }
    return pairs;
  }

  typename SourceCloud::Ptr source_; ///< the chosen points
  pcl::IndicesPtr finite_;           ///< finite chosen points
  typename SourceCloud::Ptr moved_;
  typename TargetCloud::ConstPtr target_;
  typename pcl::search::KdTree<PointTarget>::Ptr tree_;
  Eigen::Vector3d origin_;
  std::vector<int> place_; ///< in the tree, of each target point; empty: its index
};

} // namespace registration
} // namespace pcl6d
