// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/graph_relaxation/pcl/lum.h>

#include <algorithm>

namespace PCL6D_EXPORTS pcl6d {

template <typename PointT>
LUM<PointT>::LUM() : graph_(new SLAMGraph)
{
  options_.max_iterations = 5;
  options_.min_pairs = 3;
  options_.error_epsilon = 0;
}

template <typename PointT>
void
LUM<PointT>::setLoopGraph(const SLAMGraphPtr& graph)
{
  require(graph != nullptr, "loop graph", "null", "a graph");
  graph_ = graph;
}

template <typename PointT>
typename LUM<PointT>::SLAMGraph::vertices_size_type
LUM<PointT>::getNumVertices() const
{
  return num_vertices(*graph_);
}

template <typename PointT>
bool
LUM<PointT>::hasVertex(const Vertex& vertex, const char* caller) const
{
  const bool has = vertex < getNumVertices();
  if (!has)
    PCL_ERROR("[pcl6d::LUM::%s] there is no vertex %zu, but only %zu\n",
              caller,
              static_cast<std::size_t>(vertex),
              static_cast<std::size_t>(getNumVertices()));
  return has;
}

template <typename PointT>
typename LUM<PointT>::Vertex
LUM<PointT>::addPointCloud(const PointCloudPtr& cloud, const Vector6f& pose)
{
  const Vertex vertex = add_vertex(*graph_);
  (*graph_)[vertex].cloud_ = cloud;
  (*graph_)[vertex].pose_ = vertex == 0 ? Vector6f::Zero() : pose;
  if (vertex == 0 && pose != Vector6f::Zero())
    PCL_WARN(
        "[pcl6d::LUM::addPointCloud] the pose of the first cloud is fixed at zero\n");
  return vertex;
}

template <typename PointT>
void
LUM<PointT>::setPointCloud(const Vertex& vertex, const PointCloudPtr& cloud)
{
  if (hasVertex(vertex, "setPointCloud"))
    (*graph_)[vertex].cloud_ = cloud;
}

template <typename PointT>
typename LUM<PointT>::PointCloudPtr
LUM<PointT>::getPointCloud(const Vertex& vertex) const
{
  return hasVertex(vertex, "getPointCloud") ? (*graph_)[vertex].cloud_ : nullptr;
}

template <typename PointT>
void
LUM<PointT>::setPose(const Vertex& vertex, const Vector6f& pose)
{
  if (!hasVertex(vertex, "setPose"))
    return;
  if (vertex == 0)
    PCL_ERROR("[pcl6d::LUM::setPose] the pose of the first cloud is fixed\n");
  else
    (*graph_)[vertex].pose_ = pose;
}

template <typename PointT>
typename LUM<PointT>::Vector6f
LUM<PointT>::getPose(const Vertex& vertex) const
{
  if (!hasVertex(vertex, "getPose"))
    return Vector6f::Zero();
  return (*graph_)[vertex].pose_;
}

template <typename PointT>
void
LUM<PointT>::setPose3d(const Vertex& vertex, const Eigen::Isometry3d& pose)
{
  setPose(vertex, lumPose(pose));
  if (vertex == 0 || vertex >= getNumVertices())
    return;
  poses_.resize(std::max<std::size_t>(poses_.size(), vertex + 1),
                Eigen::Isometry3d::Identity());
  poses_[vertex] = pose;
}

template <typename PointT>
Eigen::Isometry3d
LUM<PointT>::getPose3d(const Vertex& vertex) const
{
  const Vector6f pose = getPose(vertex);
  if (vertex < poses_.size() && lumPose(poses_[vertex]) == pose)
    return poses_[vertex];
  const Eigen::Matrix<double, 6, 1> p = pose.template cast<double>();
  return poseFromEuler(p.template head<3>(), {p(3), p(4), p(5)});
}

template <typename PointT>
Eigen::Affine3f
LUM<PointT>::getTransformation(const Vertex& vertex) const
{
  return Eigen::Affine3f(getPose3d(vertex).matrix().template cast<float>());
}

template <typename PointT>
void
LUM<PointT>::setCorrespondences(const Vertex& source,
                                const Vertex& target,
                                const pcl::CorrespondencesPtr& correspondences)
{
  if (!hasVertex(source, "setCorrespondences") ||
      !hasVertex(target, "setCorrespondences"))
    return;
  if (source == target) {
    PCL_ERROR("[pcl6d::LUM::setCorrespondences] a vertex cannot be joined to itself\n");
    return;
  }
  const auto [present, found] = edge(source, target, *graph_);
  if (found) {
    (*graph_)[present].corrs_ = correspondences;
    return;
  }
  EdgeProperties properties;
  properties.corrs_ = correspondences;
  properties.cinv_.setZero();
  properties.cinvd_.setZero();
  add_edge(source, target, properties, *graph_);
}

template <typename PointT>
pcl::CorrespondencesPtr
LUM<PointT>::getCorrespondences(const Vertex& source, const Vertex& target) const
{
  if (!hasVertex(source, "getCorrespondences") ||
      !hasVertex(target, "getCorrespondences"))
    return nullptr;
  const auto [e, found] = edge(source, target, *graph_);
  if (!found) {
    PCL_ERROR("[pcl6d::LUM::getCorrespondences] these vertices are not joined\n");
    return nullptr;
  }
  return (*graph_)[e].corrs_;
}

template <typename PointT>
LinkPairs
LUM<PointT>::pairsOf(const Edge& edge) const
{
  LinkPairs pairs;
  pairs.from = source(edge, *graph_);
  pairs.to = target(edge, *graph_);
  if ((*graph_)[edge].corrs_ == nullptr)
    return pairs;
  for (const Vertex vertex : {pairs.from, pairs.to})
    require((*graph_)[vertex].cloud_ != nullptr, "vertex", vertex, "with a cloud");
  const PointCloud& from = *(*graph_)[pairs.from].cloud_;
  const PointCloud& to = *(*graph_)[pairs.to].cloud_;
  for (const pcl::Correspondence& match : *(*graph_)[edge].corrs_) {
    require(match.index_query >= 0 &&
                static_cast<std::size_t>(match.index_query) < from.size(),
            "index_query",
            match.index_query,
            "in the source's cloud");
    require(match.index_match >= 0 &&
                static_cast<std::size_t>(match.index_match) < to.size(),
            "index_match",
            match.index_match,
            "in the target's cloud");
    pairs.points_from.push_back(from[match.index_query].getVector3fMap());
    pairs.points_to.push_back(to[match.index_match].getVector3fMap());
  }
  return pairs;
}

template <typename PointT>
void
LUM<PointT>::compute()
{
  constexpr float kFloatEnd = 1e-7f;
  result_ = GraphSlamResult();
  if (getNumVertices() < 2) {
    PCL_ERROR("[pcl6d::LUM::compute] there must be at least 2 clouds\n");
    return;
  }
  for (Vertex v = 0; v < getNumVertices(); ++v)
    result_.poses.push_back(getPose3d(v));
  const bool finite =
      std::all_of(result_.poses.begin(), result_.poses.end(), [](const auto& pose) {
        return pose.matrix().allFinite();
      });
  if (!finite || options_.max_iterations <= 0) {
    result_.status = finite ? Status::kMaxIterations : Status::kDiverged;
    return;
  }
  options_.translation_epsilon = options_.rotation_epsilon =
      std::max(threshold_, kFloatEnd);
  std::vector<LinkPairs> links;
  const auto all = edges(*graph_);
  for (auto e = all.first; e != all.second; ++e)
    links.push_back(pairsOf(*e));
  const std::vector<Eigen::Isometry3d> start = result_.poses;
  result_ = GraphSlam(options_).relax(start, links);
  store();
}

template <typename PointT>
void
LUM<PointT>::store()
{
  poses_ = result_.poses;
  for (Vertex v = 0; v < poses_.size(); ++v)
    (*graph_)[v].pose_ = lumPose(poses_[v]);
  const auto all = edges(*graph_);
  auto link = result_.links.begin();
  for (auto e = all.first; e != all.second; ++e, ++link)
    lumEdge(*link, (*graph_)[*e].cinv_, (*graph_)[*e].cinvd_);
}

template <typename PointT>
typename LUM<PointT>::PointCloudPtr
LUM<PointT>::getTransformedCloud(const Vertex& vertex) const
{
  const PointCloudPtr cloud = getPointCloud(vertex);
  require(cloud != nullptr, "vertex", vertex, "with a cloud");
  PointCloudPtr out(new PointCloud);
  pcl::transformPointCloud(*cloud, *out, getTransformation(vertex));
  return out;
}

template <typename PointT>
typename LUM<PointT>::PointCloudPtr
LUM<PointT>::getConcatenatedCloud() const
{
  PointCloudPtr out(new PointCloud);
  for (Vertex v = 0; v < getNumVertices(); ++v)
    *out += *getTransformedCloud(v);
  return out;
}

} // namespace pcl6d
