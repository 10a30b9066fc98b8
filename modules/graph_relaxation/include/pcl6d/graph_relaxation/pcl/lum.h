// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/graph_relaxation/graph_slam.h>

#include <pcl/common/transforms.h>
#include <pcl/registration/lum.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Globally consistent scan matching with the interface and graph type of
 * pcl::registration::LUM: changing the class name is enough.
 *
 * PCL's class diverges when scans are turned (its derivative belongs to a different order of
 * the angles), and solves a dense system in float. This class runs GraphSlam: correct for every
 * heading, sparse, in double, with a status in result(). Calls that PCL answers with a
 * PCL_ERROR print PCL_ERROR here, too; the poses are then unchanged.
 *
 * Differences:
 * - links weigh by the variance of their pairs (PCL: by their sum of squares, so that cinv_
 *   and cinvd_ of an edge are larger by the degrees of freedom);
 * - non-finite poses are not changed, and result() says kDiverged (PCL: NaN);
 * - undefined behaviour of PCL throws BadArgument: see compute(), setLoopGraph(),
 *   getTransformedCloud();
 * - derived classes have no computeEdge() and incidenceCorrection().
 *
 * The poses in the graph stay PCL's float vectors (x, y, z, roll, pitch, yaw); getPose3d()
 * gives the pose in double.
 * \code
 * pcl6d::LUM<pcl::PointXYZ> lum;
 * lum.addPointCloud(cloud_0);
 * lum.addPointCloud(cloud_1, guess);
 * lum.setCorrespondences(0, 1, correspondences); // query in cloud_0, match in cloud_1
 * lum.compute();
 * if (lum.result().status != pcl6d::Status::kOk)
 *   std::cerr << pcl6d::toString(lum.result().status) << '\n';
 * \endcode
 * \note Source: see GraphSlam. Book: 5.2.
 * \ingroup graph_relaxation */
template <typename PointT>
class LUM {
public:
  using Peer = pcl::registration::LUM<PointT>;
  using Ptr = pcl::shared_ptr<LUM<PointT>>;
  using ConstPtr = pcl::shared_ptr<const LUM<PointT>>;
  using PointCloud = typename Peer::PointCloud;
  using PointCloudPtr = typename Peer::PointCloudPtr;
  using PointCloudConstPtr = typename Peer::PointCloudConstPtr;
  using VertexProperties = typename Peer::VertexProperties;
  using EdgeProperties = typename Peer::EdgeProperties;
  using SLAMGraph = typename Peer::SLAMGraph;
  using SLAMGraphPtr = typename Peer::SLAMGraphPtr;
  using Vertex = typename Peer::Vertex;
  using Edge = typename Peer::Edge;
  using Vector6f = Eigen::Matrix<float, 6, 1>;

  /** \brief Five iterations, threshold 0, as PCL's. */
  LUM();

  /** \param[in] graph may come from PCL's class \throws BadArgument null */
  void
  setLoopGraph(const SLAMGraphPtr& graph);

  SLAMGraphPtr
  getLoopGraph() const
  {
    return graph_;
  }

  typename SLAMGraph::vertices_size_type
  getNumVertices() const;

  /** \brief With 0 or fewer, compute() changes nothing, like PCL's. */
  void
  setMaxIterations(int max_iterations)
  {
    options_.max_iterations = max_iterations;
  }

  int
  getMaxIterations() const
  {
    return options_.max_iterations;
  }

  /** \brief Stop when no pose moved by more than the threshold [m] or turned by more [rad]. 0:
   * the resolution of float poses, 1e-7. */
  void
  setConvergenceThreshold(float threshold)
  {
    threshold_ = threshold;
  }

  float
  getConvergenceThreshold() const
  {
    return threshold_;
  }

  /** \brief The remaining options; max_iterations and both epsilons are set by the setters
   * above. */
  GraphSlamOptions&
  options()
  {
    return options_;
  }

  /** \brief Adds a scan. The first pose is fixed at zero.
   * \param[in] cloud may be null until its first use */
  Vertex
  addPointCloud(const PointCloudPtr& cloud, const Vector6f& pose = Vector6f::Zero());

  /** \brief An unknown vertex: PCL_ERROR without effect, here and below; getters then return
   * null, zero or the identity, like PCL's. */
  void
  setPointCloud(const Vertex& vertex, const PointCloudPtr& cloud);
  PointCloudPtr
  getPointCloud(const Vertex& vertex) const;

  /** \brief Sets (x, y, z, roll, pitch, yaw) [m, rad]; ignored for vertex 0, as in PCL. */
  void
  setPose(const Vertex& vertex, const Vector6f& pose);
  Vector6f
  getPose(const Vertex& vertex) const;

  /** \brief Sets the pose in double. Kept until the float pose in the graph is changed. */
  void
  setPose3d(const Vertex& vertex, const Eigen::Isometry3d& pose);
  Eigen::Isometry3d
  getPose3d(const Vertex& vertex) const;

  Eigen::Affine3f
  getTransformation(const Vertex& vertex) const;

  /** \brief Adds or replaces the pairs of an edge: query indices in the source's cloud, match
   * indices in the target's. Source equal to target: PCL_ERROR without effect. */
  void
  setCorrespondences(const Vertex& source,
                     const Vertex& target,
                     const pcl::CorrespondencesPtr& correspondences);

  /** \return null for an unknown edge, with a PCL_ERROR */
  pcl::CorrespondencesPtr
  getCorrespondences(const Vertex& source, const Vertex& target) const;

  /** \brief Moves every scan except the first; writes the graph's poses, and per edge C^-1 and
   * C^-1 D about the world origin in PCL's order x, y, z, turns about x, z, y. Fewer than 2
   * vertices: PCL_ERROR without effect.
   * \throws BadArgument an invalid field of options(), a vertex with pairs but no cloud, or an
   * index out of range */
  void
  compute();

  /** \return the result of the last compute(); links in the order of the graph's edges */
  const GraphSlamResult&
  result() const
  {
    return result_;
  }

  /** \throws BadArgument a vertex without a cloud, here and below */
  PointCloudPtr
  getTransformedCloud(const Vertex& vertex) const;

  PointCloudPtr
  getConcatenatedCloud() const;

private:
  bool
  hasVertex(const Vertex& vertex, const char* caller) const;
  LinkPairs
  pairsOf(const Edge& edge) const;
  void
  store();

  SLAMGraphPtr graph_;
  GraphSlamOptions options_;
  float threshold_ = 0;
  GraphSlamResult result_;
  std::vector<Eigen::Isometry3d>
      poses_; ///< in double, valid while equal to the graph's
};

/** \brief (x, y, z, roll, pitch, yaw) of a pose in the format of PCL's LUM. */
Eigen::Matrix<float, 6, 1>
lumPose(const Eigen::Isometry3d& pose);

/** \brief C^-1 and C^-1 D about the world origin, in the format of an edge of PCL's LUM: in the
 * order x, y, z, turns about x, z, y. */
void
lumEdge(const LinkReport& link,
        Eigen::Matrix<float, 6, 6>& information,
        Eigen::Matrix<float, 6, 1>& moment);

} // namespace pcl6d

#include <pcl6d/graph_relaxation/pcl/impl/lum.hpp>
PCL6D_DECLARE_INSTANCES(pcl6d::LUM)
