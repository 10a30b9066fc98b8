// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/registration/icp_model.h>
#include <pcl6d/registration/minimisers.h>
#include <pcl6d/registration/plane_minimiser.h>

#include <pcl/point_types.h>
#include <pcl/registration/registration.h>
#include <pcl/search/kdtree.h>
#include <pcl/search/search.h>

#include <string>
#include <vector>

/** \file
 * Makes PCL classes from words of the command line: an option of a program becomes an object
 * behind a pointer to PCL's base class. For an unknown word, BadArgument lists the known words.
 * \code
 * pcl::IterativeClosestPoint<PointT, PointT> icp; // PCL's own
 * icp.setTransformationEstimation(pcl6d::registration::make<PointT, PointT>("helix"));
 * icp.setSearchMethodTarget(pcl6d::makeKdTree<PointT>("cached-tree"));
 * const auto registration = pcl6d::makeRegistration<PointT, PointT>("gicp");
 * \endcode */
namespace PCL6D_EXPORTS pcl6d {

/** \return a minimiser of the distances of points: one of minimiserNames()
 * \throws BadArgument unknown word \ingroup registration */
template <typename PointSource, typename PointTarget, typename Scalar = float>
typename pcl::registration::TransformationEstimation<PointSource, PointTarget, Scalar>::
    Ptr
    makeTransformationEstimation(const std::string& name);

/** \return a minimiser of the distances from points to planes: one of planeMinimiserNames();
 * the target's points must have normals
 * \throws BadArgument unknown word \ingroup registration */
template <typename PointSource, typename PointTarget, typename Scalar = float>
typename pcl::registration::TransformationEstimation<PointSource, PointTarget, Scalar>::
    Ptr
    makePlaneTransformationEstimation(const std::string& name);

/** \return the words of makeRegistration(): point, plane, gicp (of `--metric`), ndt, overlap,
 * features (of `--initial-guess`) */
std::vector<std::string>
registrationNames();

/** \return ICP6D, ICP6DWithNormals, GICP6D, NDT6D, OverlapAlignment or FeatureAlignment, with
 * its defaults
 * \throws BadArgument unknown word \ingroup registration */
template <typename PointSource, typename PointTarget, typename Scalar = float>
typename pcl::Registration<PointSource, PointTarget, Scalar>::Ptr
makeRegistration(const std::string& name);

/** \return the search for a word of searchMethodNames(). kdtree and remembered are KdTree: with a
 * KdTree, ICP6D remembers neighbours; approximate finds neighbours up to a tenth farther; flann is
 * PCL's own class
 * \throws BadArgument unknown word \ingroup registration */
template <typename PointT>
typename pcl::search::Search<PointT>::Ptr
makeSearch(const std::string& name);

/** \return the search for a word as a pcl::search::KdTree, the only type accepted by
 * pcl::Registration
 * \throws BadArgument unknown word, or octree or brute-force, which are no k-d trees */
template <typename PointT>
typename pcl::search::KdTree<PointT>::Ptr
makeKdTree(const std::string& name);

namespace registration {
/** \brief Short for makeTransformationEstimation(): `registration::make("helix")`. */
template <typename PointSource = pcl::PointXYZ,
          typename PointTarget = PointSource,
          typename Scalar = float>
typename pcl::registration::TransformationEstimation<PointSource, PointTarget, Scalar>::
    Ptr
    make(const std::string& name)
{
  return makeTransformationEstimation<PointSource, PointTarget, Scalar>(name);
}
} // namespace registration

} // namespace pcl6d
#include <pcl6d/registration/pcl/impl/make.hpp>
