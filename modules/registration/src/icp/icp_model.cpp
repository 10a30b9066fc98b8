// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>
#include <pcl6d/filters/voxel_reduction.h>
#include <pcl6d/registration/icp_model.h>
#include <pcl6d/search/flann_tree.h>
#include <pcl6d/search/point_list.h>
#include <pcl6d/search/point_octree.h>

#include <utility>

namespace pcl6d {

namespace {
constexpr double kApproximation = 0.1; ///< epsilon of the approximate search
constexpr double kVoxelsOfPatch =
    3; ///< usual ratio of normal_voxel to the points' voxel

constexpr Named<SearchMethod> kMethods[] = {{SearchMethod::kKdTree, "kdtree"},
                                            {SearchMethod::kCachedTree, "cached-tree"},
                                            {SearchMethod::kRemembered, "remembered"},
                                            {SearchMethod::kApproximate, "approximate"},
                                            {SearchMethod::kOctree, "octree"},
                                            {SearchMethod::kBruteForce, "brute-force"},
                                            {SearchMethod::kFlann, "flann"}};
constexpr char kFormerWord[] = "cached"; ///< of kRemembered, in older command lines

/** \return the plain search of a structure made here */
template <typename Structure>
NearestSearch
searchOf(const Points& points)
{
  return [structure = std::make_shared<const Structure>(points)](
             const Eigen::Vector3f& query, float max_distance_sq) {
    return structure->nearest(query, max_distance_sq);
  };
}
} // namespace

std::vector<std::string>
searchMethodNames()
{
  return namesOf(kMethods);
}

SearchMethod
searchMethodFromName(const std::string& name)
{
  return name == kFormerWord ? SearchMethod::kRemembered
                             : fromName(kMethods, "search", name);
}

const char*
toString(SearchMethod method)
{
  return nameOf(kMethods, method);
}

IcpModel::IcpModel(Points points, const Options& options)
: points_(std::move(points)), has_normals_(options.normals)
{
  build(options);
  if (options.normals)
    normals_ = makeNormals(options);
}

IcpModel::IcpModel(Points points, Normals normals, const Options& options)
: points_(std::move(points)), normals_(std::move(normals)), has_normals_(true)
{
  require(
      normals_.size() == points_.size(), "normals", normals_.size(), "one per point");
  build(options);
}

Normals
IcpModel::makeNormals(const Options& options) const
{
  if (options.normal_voxel == 0)
    return estimateNormals(points_, *tree_, options.neighbours, options.num_threads);
  ReductionOptions reduction;
  reduction.voxel = options.normal_voxel;
  return estimateSurfaceNormals(
      points_,
      *tree_,
      reducePoints(points_, reduction),
      {options.neighbours, options.normal_voxel / kVoxelsOfPatch, options.num_threads});
}

void
IcpModel::build(const Options& options)
{
  const bool starts_at_leaves =
      !options.make_search && options.search == SearchMethod::kCachedTree;
  tree_ = std::make_shared<const PointTree>(points_,
                                            options.num_threads,
                                            starts_at_leaves ? PointTree::Cells::kKeep
                                                             : PointTree::Cells::kNone);
  if (options.make_search) {
    search_ = options.make_search(points_);
    require(search_ != nullptr, "search made", "none", "a function");
    return;
  }
  switch (options.search) {
  case SearchMethod::kRemembered:
    memory_ = SearchMemory::kNeighbours;
    break;
  case SearchMethod::kCachedTree:
    memory_ = SearchMemory::kLeaves;
    break;
  case SearchMethod::kKdTree:
    search_ = [tree = tree_](const Eigen::Vector3f& query, float max_distance_sq) {
      return tree->nearest(query, max_distance_sq);
    };
    break;
  case SearchMethod::kApproximate:
    search_ = [tree = tree_](const Eigen::Vector3f& query, float max_distance_sq) {
      return tree->nearestApproximate(query, max_distance_sq, kApproximation);
    };
    break;
  case SearchMethod::kOctree:
    search_ = searchOf<PointOctree>(points_);
    break;
  case SearchMethod::kBruteForce:
    search_ = searchOf<PointList>(points_);
    break;
  case SearchMethod::kFlann:
    search_ = searchOf<FlannTree>(points_);
    break;
  }
}

IcpSource
IcpModel::source() const
{
  return {&points_, has_normals_ ? &normals_ : nullptr};
}

IcpTargetPart
IcpModel::part(const Eigen::Isometry3d& T_target_part) const
{
  return {tree_.get(),
          &points_,
          has_normals_ ? &normals_ : nullptr,
          T_target_part,
          search_,
          memory_};
}

} // namespace pcl6d
