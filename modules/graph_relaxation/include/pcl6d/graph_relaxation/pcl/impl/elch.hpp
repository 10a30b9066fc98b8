// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/graph_relaxation/pcl/elch.h>
#include <pcl6d/registration/pcl/icp6d.h>

#include <pcl/common/point_tests.h>
#include <pcl/common/transforms.h>

namespace PCL6D_EXPORTS pcl6d {

template <typename PointT>
ELCH<PointT>::ELCH() : loop_graph_(new LoopGraph), reg_(new ICP6D<PointT, PointT>)
{}

template <typename PointT>
void
ELCH<PointT>::addPointCloud(const PointCloudPtr& cloud)
{
  require(cloud != nullptr, "cloud", "null", "given");
  const VertexId added = add_vertex(*loop_graph_);
  (*loop_graph_)[added].cloud = cloud;
  if (added > 0)
    add_edge(added - 1, added, *loop_graph_);
}

template <typename PointT>
void
ELCH<PointT>::addPointCloud(const PointCloudPtr& cloud, const Eigen::Vector3d& position)
{
  require(position.allFinite(), "position", position.transpose(), "finite");
  addPointCloud(cloud);
  (*loop_graph_)[num_vertices(*loop_graph_) - 1].position = position;
}

template <typename PointT>
void
ELCH<PointT>::setLoopGraph(const LoopGraphPtr& loop_graph)
{
  require(loop_graph != nullptr, "loop graph", "null", "given");
  loop_graph_ = loop_graph;
}

template <typename PointT>
void
ELCH<PointT>::setEdgeCovariance(VertexId a, VertexId b, const Covariance& covariance)
{
  costOfCovariance(covariance); // checks it
  const VertexId count = num_vertices(*loop_graph_);
  const bool known = a < count && b < count;
  const auto found =
      known ? edge(a, b, *loop_graph_) : decltype(edge(a, b, *loop_graph_))();
  require(known && found.second,
          "edge",
          std::to_string(a) + " to " + std::to_string(b),
          "one of the loop graph");
  (*loop_graph_)[found.first].covariance = covariance;
}

template <typename PointT>
void
ELCH<PointT>::setReg(const RegistrationPtr& reg)
{
  require(reg != nullptr, "registration", "null", "given");
  reg_ = reg;
}

template <typename PointT>
void
ELCH<PointT>::setLoopTransform(const Eigen::Matrix4f& loop_transform)
{
  const Eigen::Isometry3d motion(loop_transform.cast<double>());
  require(isRigid(motion), "loop transform", loop_transform, "finite and rigid");
  loop_transform_ = loop_transform;
  register_loop_ = false;
}

template <typename PointT>
void
ELCH<PointT>::requireScans() const
{
  const VertexId count = num_vertices(*loop_graph_);
  const std::string rule = "less than the " + std::to_string(count) + " scans";
  require(loop_start_ < count, "loop start", loop_start_, rule);
  require(loop_end_ < count, "loop end", loop_end_, rule);
  require(
      loop_start_ != loop_end_, "loop end", loop_end_, "another scan than the start");
  for (VertexId v = 0; v < count; ++v)
    require((*loop_graph_)[v].cloud != nullptr,
            ("cloud of vertex " + std::to_string(v)).c_str(),
            "null",
            "given");
}

/** \return a cloud with the points of the scan and of its adjacent scans */
template <typename PointT>
typename ELCH<PointT>::PointCloudPtr
ELCH<PointT>::withNeighbours(VertexId vertex) const
{
  const PointCloudPtr all(new PointCloud(*(*loop_graph_)[vertex].cloud));
  const auto [begin, end] = adjacent_vertices(vertex, *loop_graph_);
  for (auto v = begin; v != end; ++v)
    *all += *(*loop_graph_)[*v].cloud;
  return all;
}

/** \return the motion that closes the loop; empty if the registration neither converged nor
 * reported its iteration limit */
template <typename PointT>
std::optional<Eigen::Matrix4f>
ELCH<PointT>::loopMotion()
{
  is_at_rest_ = true;
  if (!register_loop_)
    return loop_transform_;
  reg_->setInputTarget(withNeighbours(loop_start_));
  reg_->setInputSource(withNeighbours(loop_end_));
  PointCloud aligned;
  reg_->align(aligned);
  const Eigen::Matrix4f found = reg_->getFinalTransformation();
  using Ours = ICP6D<PointT, PointT>;
  const auto ours = std::dynamic_pointer_cast<const Ours>(reg_);
  is_at_rest_ = !ours || ours->result().stop != IcpStop::kIterationLimit;
  if ((is_at_rest_ && !reg_->hasConverged()) ||
      !isRigid(Eigen::Isometry3d(found.cast<double>())))
    return std::nullopt;
  return found;
}

/** \return poses at the scanner positions, with the world axes */
template <typename PointT>
std::vector<Eigen::Isometry3d>
ELCH<PointT>::positions() const
{
  std::vector<Eigen::Isometry3d> poses;
  for (VertexId v = 0; v < num_vertices(*loop_graph_); ++v) {
    const Vertex& scan = (*loop_graph_)[v];
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    std::size_t count = 0;
    if (!scan.position)
      for (const auto& p : *scan.cloud)
        if (pcl::isXYZFinite(p)) {
          sum += p.getVector3fMap().template cast<double>();
          ++count;
        }
    require(!scan.position || scan.position->allFinite(),
            ("position of vertex " + std::to_string(v)).c_str(),
            "not finite",
            "finite");
    require(scan.position || count > 0,
            ("finite points of vertex " + std::to_string(v)).c_str(),
            0,
            "at least 1 unless it has a position");
    poses.emplace_back(Eigen::Translation3d(
        scan.position ? *scan.position : sum / static_cast<double>(count)));
  }
  return poses;
}

template <typename PointT>
std::vector<LoopEdge>
ELCH<PointT>::edgesWithCosts(const std::vector<Eigen::Isometry3d>& poses) const
{
  std::vector<LoopEdge> known, unknown;
  PerDimension sum = PerDimension::Zero();
  const auto [begin, end] = edges(*loop_graph_);
  for (auto e = begin; e != end; ++e) {
    LoopEdge joined{source(*e, *loop_graph_), target(*e, *loop_graph_)};
    if (joined.a == joined.b)
      continue; // says nothing
    const std::optional<Covariance>& covariance = (*loop_graph_)[*e].covariance;
    if (covariance)
      sum += joined.cost = costOfCovariance(*covariance);
    (covariance ? known : unknown).push_back(joined);
  }
  for (auto& joined : unknown)
    if (known.empty())
      joined.cost.setConstant(
          (poses[joined.a].translation() - poses[joined.b].translation()).norm());
    else
      joined.cost = sum / static_cast<double>(known.size());
  known.insert(known.end(), unknown.begin(), unknown.end());
  return known;
}

template <typename PointT>
void
ELCH<PointT>::moveScan(Vertex& vertex, const Eigen::Isometry3d& correction)
{
  const PointCloudPtr moved(new PointCloud);
  if constexpr (pcl::traits::has_normal<PointT>::value)
    pcl::transformPointCloudWithNormals(*vertex.cloud, *moved, correction.matrix());
  else
    pcl::transformPointCloud(*vertex.cloud, *moved, correction.matrix());
  if (modify_input_clouds_)
    vertex.cloud->swap(*moved);
  else
    vertex.cloud = moved;
  vertex.transform = Eigen::Affine3f(correction.matrix().template cast<float>());
  if (vertex.position)
    vertex.position = correction * *vertex.position;
}

template <typename PointT>
void
ELCH<PointT>::compute()
{
  requireScans();
  const std::vector<Eigen::Isometry3d> poses = positions();
  const std::vector<LoopEdge> joined = edgesWithCosts(poses);
  corrections_.clear();
  status_ = Status::kDiverged;
  const std::optional<Eigen::Matrix4f> motion = loopMotion();
  if (!motion)
    return;
  Eigen::Isometry3d closing(motion->cast<double>());
  closing.linear() = nearestRotation(closing.linear());
  const Loop loop{loop_start_, loop_end_, closing * poses[loop_end_]};
  const ErrorDiffusionResult diffused = closeLoop(poses, joined, loop, options_);
  status_ = diffused.status;
  if (status_ == Status::kDiverged)
    return;
  if (status_ == Status::kOk && !is_at_rest_)
    status_ = Status::kMaxIterations;
  loop_transform_ = *motion;
  for (VertexId v = 0; v < poses.size(); ++v) {
    corrections_.push_back(diffused.poses[v] * poses[v].inverse());
    moveScan((*loop_graph_)[v], corrections_[v]);
  }
  add_edge(loop_start_, loop_end_, *loop_graph_);
}

} // namespace pcl6d
