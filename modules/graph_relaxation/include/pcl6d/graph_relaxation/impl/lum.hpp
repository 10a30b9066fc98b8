// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/graph_relaxation/lum.h>

#include <algorithm>

namespace pcl6d {

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
void
LUM<PointT>::requireVertex(const Vertex& vertex) const
{
  require(vertex < getNumVertices(),
          "vertex",
          vertex,
          "< " + std::to_string(getNumVertices()) + ", the number of clouds");
}

template <typename PointT>
typename LUM<PointT>::Vertex
LUM<PointT>::addPointCloud(const PointCloudPtr& cloud, const Vector6f& pose)
{
  require(cloud != nullptr, "cloud", "null", "a cloud");
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
  requireVertex(vertex);
  require(cloud != nullptr, "cloud", "null", "a cloud");
  (*graph_)[vertex].cloud_ = cloud;
}

template <typename PointT>
typename LUM<PointT>::PointCloudPtr
LUM<PointT>::getPointCloud(const Vertex& vertex) const
{
  requireVertex(vertex);
  return (*graph_)[vertex].cloud_;
}

template <typename PointT>
void
LUM<PointT>::setPose(const Vertex& vertex, const Vector6f& pose)
{
  requireVertex(vertex);
  if (vertex == 0)
    PCL_WARN("[pcl6d::LUM::setPose] the pose of the first cloud is fixed\n");
  else
    (*graph_)[vertex].pose_ = pose;
}

template <typename PointT>
typename LUM<PointT>::Vector6f
LUM<PointT>::getPose(const Vertex& vertex) const
{
  requireVertex(vertex);
  return (*graph_)[vertex].pose_;
}

template <typename PointT>
void
LUM<PointT>::setPose3d(const Vertex& vertex, const Eigen::Isometry3d& pose)
{
  setPose(vertex, lumPose(pose));
  if (vertex == 0)
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
  requireVertex(source);
  requireVertex(target);
  require(source != target, "target", target, "another vertex than the source");
  require(correspondences != nullptr, "correspondences", "null", "a list");
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
  requireVertex(source);
  requireVertex(target);
  const auto [e, found] = edge(source, target, *graph_);
  require(found, "target", target, "joined to the source by correspondences");
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
  options_.translation_epsilon = options_.rotation_epsilon =
      std::max(threshold_, kFloatEnd);
  std::vector<Eigen::Isometry3d> start;
  for (Vertex v = 0; v < getNumVertices(); ++v)
    start.push_back(getPose3d(v));
  std::vector<LinkPairs> links;
  const auto all = edges(*graph_);
  for (auto e = all.first; e != all.second; ++e)
    links.push_back(pairsOf(*e));
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
