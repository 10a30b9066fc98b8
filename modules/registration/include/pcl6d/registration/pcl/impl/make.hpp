// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/name_table.h>
#include <pcl6d/registration/icp_model.h>
#include <pcl6d/registration/pcl/feature_alignment.h>
#include <pcl6d/registration/pcl/gicp6d.h>
#include <pcl6d/registration/pcl/icp6d.h>
#include <pcl6d/registration/pcl/icp6d_with_normals.h>
#include <pcl6d/registration/pcl/ndt6d.h>
#include <pcl6d/registration/pcl/overlap_alignment.h>
#include <pcl6d/registration/pcl/transformation_estimation_dual_quaternion.h>
#include <pcl6d/registration/pcl/transformation_estimation_euler.h>
#include <pcl6d/registration/pcl/transformation_estimation_helix.h>
#include <pcl6d/registration/pcl/transformation_estimation_orthonormal.h>
#include <pcl6d/registration/pcl/transformation_estimation_plane_helix.h>
#include <pcl6d/registration/pcl/transformation_estimation_plane_linear.h>
#include <pcl6d/registration/pcl/transformation_estimation_quaternion.h>
#include <pcl6d/registration/pcl/transformation_estimation_quaternion_linear.h>
#include <pcl6d/registration/pcl/transformation_estimation_scale_quaternion.h>
#include <pcl6d/registration/pcl/transformation_estimation_small_angle.h>
#include <pcl6d/registration/pcl/transformation_estimation_svd.h>
#include <pcl6d/search/pcl/approximate_kd_tree.h>
#include <pcl6d/search/pcl/brute_force_search.h>
#include <pcl6d/search/pcl/cached_kd_tree.h>
#include <pcl6d/search/pcl/kd_tree.h>
#include <pcl6d/search/pcl/octree_search.h>

namespace pcl6d {
namespace registration {

/** Kinds of makeRegistration(): metrics, NDT, and searches for an initial pose. */
enum class RegistrationKind { kPoint, kPlane, kGicp, kNdt, kOverlap, kFeatures };

/** \throws BadArgument unknown word */
PCL6D_EXPORTS RegistrationKind
registrationKindFromName(const std::string& name);

/** \throws BadArgument always: this search has no k-d tree */
[[noreturn]] PCL6D_EXPORTS void
refuseNoKdTree(SearchMethod method);

constexpr float kTenth = 0.1F; ///< how much farther `--search approximate` allows

/** Makes an object of a class behind a pointer to its base. */
template <typename Base, typename Class>
typename Base::Ptr
madeAs()
{
  return typename Base::Ptr(new Class);
}

} // namespace registration

template <typename PointSource, typename PointTarget, typename Scalar>
typename pcl::registration::TransformationEstimation<PointSource, PointTarget, Scalar>::
    Ptr
    makeTransformationEstimation(const std::string& name)
{
  using Base =
      pcl::registration::TransformationEstimation<PointSource, PointTarget, Scalar>;
  using Make = typename Base::Ptr (*)();
  using registration::madeAs;
#define PCL6D_MADE_(Class)                                                             \
  madeAs<Base, TransformationEstimation##Class<PointSource, PointTarget, Scalar>>
  static constexpr Named<Make> kTable[] = {
      {PCL6D_MADE_(SVD), "svd"},
      {PCL6D_MADE_(Quaternion), "quaternion"},
      {PCL6D_MADE_(Orthonormal), "orthonormal"},
      {PCL6D_MADE_(DualQuaternion), "dual-quaternion"},
      {PCL6D_MADE_(ScaleQuaternion), "scale-quaternion"},
      {PCL6D_MADE_(Helix), "helix"},
      {PCL6D_MADE_(SmallAngle), "small-angle"},
      {PCL6D_MADE_(Euler), "euler"},
      {PCL6D_MADE_(QuaternionLinear), "quaternion-linear"}};
  return fromName(kTable, "minimiser", name)();
}

template <typename PointSource, typename PointTarget, typename Scalar>
typename pcl::registration::TransformationEstimation<PointSource, PointTarget, Scalar>::
    Ptr
    makePlaneTransformationEstimation(const std::string& name)
{
  using Base =
      pcl::registration::TransformationEstimation<PointSource, PointTarget, Scalar>;
  using Make = typename Base::Ptr (*)();
  using registration::madeAs;
  static constexpr Named<Make> kTable[] = {{PCL6D_MADE_(PlaneLinear), "linear"},
                                           {PCL6D_MADE_(PlaneHelix), "helix"}};
#undef PCL6D_MADE_
  return fromName(kTable, "plane_minimiser", name)();
}

template <typename PointSource, typename PointTarget, typename Scalar>
typename pcl::Registration<PointSource, PointTarget, Scalar>::Ptr
makeRegistration(const std::string& name)
{
  using Base = pcl::Registration<PointSource, PointTarget, Scalar>;
  using registration::madeAs;
  using registration::RegistrationKind;
  switch (registration::registrationKindFromName(name)) {
  case RegistrationKind::kPlane:
    return madeAs<Base, ICP6DWithNormals<PointSource, PointTarget, Scalar>>();
  case RegistrationKind::kGicp:
    return madeAs<Base, GICP6D<PointSource, PointTarget, Scalar>>();
  case RegistrationKind::kNdt:
    return madeAs<Base, NDT6D<PointSource, PointTarget, Scalar>>();
  case RegistrationKind::kOverlap:
    return madeAs<Base, OverlapAlignment<PointSource, PointTarget, Scalar>>();
  case RegistrationKind::kFeatures:
    return madeAs<Base, FeatureAlignment<PointSource, PointTarget, Scalar>>();
  case RegistrationKind::kPoint:
    break;
  }
  return madeAs<Base, ICP6D<PointSource, PointTarget, Scalar>>();
}

template <typename PointT>
typename pcl::search::KdTree<PointT>::Ptr
makeKdTree(const std::string& name)
{
  using Base = pcl::search::KdTree<PointT>;
  using registration::madeAs;
  const SearchMethod method = searchMethodFromName(name);
  switch (method) {
  case SearchMethod::kKdTree:
  case SearchMethod::kRemembered:
    return madeAs<Base, KdTree<PointT>>();
  case SearchMethod::kCachedTree:
    return madeAs<Base, CachedKdTree<PointT>>();
  case SearchMethod::kApproximate:
    return typename Base::Ptr(new ApproximateKdTree<PointT>(registration::kTenth));
  case SearchMethod::kFlann:
    return madeAs<Base, Base>();
  case SearchMethod::kOctree:
  case SearchMethod::kBruteForce:
    break;
  }
  registration::refuseNoKdTree(method);
}

template <typename PointT>
typename pcl::search::Search<PointT>::Ptr
makeSearch(const std::string& name)
{
  using Base = pcl::search::Search<PointT>;
  using registration::madeAs;
  const SearchMethod method = searchMethodFromName(name);
  if (method == SearchMethod::kOctree)
    return madeAs<Base, OctreeSearch<PointT>>();
  if (method == SearchMethod::kBruteForce)
    return madeAs<Base, BruteForceSearch<PointT>>();
  return makeKdTree<PointT>(name);
}

#define PCL6D_MAKE_PAIR_(start, PointT, Scalar)                                        \
  start template pcl::registration::TransformationEstimation<PointT, PointT, Scalar>:: \
      Ptr                                                                              \
      makeTransformationEstimation<PointT, PointT, Scalar>(const std::string&);        \
  start template pcl::Registration<PointT, PointT, Scalar>::Ptr                        \
  makeRegistration<PointT, PointT, Scalar>(const std::string&);
#define PCL6D_MAKE_ALL_(start, PointT)                                                 \
  PCL6D_MAKE_PAIR_(start, PointT, float)                                               \
  PCL6D_MAKE_PAIR_(start, PointT, double)                                              \
  start template pcl::search::KdTree<PointT>::Ptr makeKdTree<PointT>(                  \
      const std::string&);                                                             \
  start template pcl::search::Search<PointT>::Ptr makeSearch<PointT>(                  \
      const std::string&);

PCL6D_FOR_POINT_TYPES(PCL6D_MAKE_ALL_, extern)

} // namespace pcl6d
