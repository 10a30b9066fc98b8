// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/graph_relaxation/graph_slam.h>

#include <pcl/common/transforms.h>
#include <pcl/registration/lum.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Globally consistent scan matching with the interface of pcl::registration::LUM,
 * whose graph type it shares: changing the class name is enough.
 *
 * Where PCL's class diverges as soon as scans are turned (its derivative belongs to another
 * order of the angles) and solves a dense system in float, this one runs GraphSlam: right
 * for all headings, sparse, in double, and honest: see result(). Calls that PCL answers
 * with a PCL_ERROR do the same here; without an answer the poses stay as they were.
 *
 * Differences:
 * - links weigh by the variance of their pairs (PCL: by their sum of squares, so that
 *   cinv_ and cinvd_ of an edge are larger by the degrees of freedom);
 * - poses that are not finite are left alone, and result() says kDiverged (PCL: NaN);
 * - what PCL leaves undefined throws BadArgument: see compute(), setLoopGraph(),
 *   getTransformedCloud();
 * - computeEdge() and incidenceCorrection() are not there for derived classes.
 *
 * The poses in the graph stay PCL's float vectors (x, y, z, roll, pitch, yaw);
 * getPose3d() gives the same in double.
 * \code
 * pcl6d::LUM<pcl::PointXYZ> lum;
 * lum.addPointCloud(cloud_0);
 * lum.addPointCloud(cloud_1, guess);
 * lum.setCorrespondences(0, 1, correspondences); // query in cloud_0, match in cloud_1
 * lum.compute();
 * if (lum.result().status != pcl6d::Status::kOk)
 *   std::cerr << pcl6d::toString(lum.result().status) << '\n';
 * \endcode
 * \note Source: see GraphSlam. Book: 5.2. \ingroup graph_relaxation */
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

  /** \brief 0 or fewer: compute() changes nothing, as PCL's. */
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

  /** \brief Stop when no pose moved more [m] and none turned more [rad]. 0: at what float
   * poses can hold, 1e-7. */
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

  /** \brief All other knobs; max_iterations and both epsilons are set by the setters
   * above. */
  GraphSlamOptions&
  options()
  {
    return options_;
  }

  /** \brief Adds a scan. The pose of the first one is fixed at zero. \param[in] cloud may
   * be null until it is needed */
  Vertex
  addPointCloud(const PointCloudPtr& cloud, const Vector6f& pose = Vector6f::Zero());

  /** \brief Without such a vertex: PCL_ERROR, and nothing happens, here and below; getters
   * return null, zero or the identity then, as PCL's. */
  void
  setPointCloud(const Vertex& vertex, const PointCloudPtr& cloud);
  PointCloudPtr
  getPointCloud(const Vertex& vertex) const;

  /** \brief Sets (x, y, z, roll, pitch, yaw) [m, rad]; ignored for vertex 0, as in PCL. */
  void
  setPose(const Vertex& vertex, const Vector6f& pose);
  Vector6f
  getPose(const Vertex& vertex) const;

  /** \brief The same in double. Kept until the float pose in the graph is changed. */
  void
  setPose3d(const Vertex& vertex, const Eigen::Isometry3d& pose);
  Eigen::Isometry3d
  getPose3d(const Vertex& vertex) const;

  Eigen::Affine3f
  getTransformation(const Vertex& vertex) const;

  /** \brief Adds or replaces the pairs of an edge: query indices in the source's cloud,
   * match indices in the target's. Both the same: PCL_ERROR, and nothing happens. */
  void
  setCorrespondences(const Vertex& source,
                     const Vertex& target,
                     const pcl::CorrespondencesPtr& correspondences);

  /** \return null without such an edge, with a PCL_ERROR */
  pcl::CorrespondencesPtr
  getCorrespondences(const Vertex& source, const Vertex& target) const;

  /** \brief Moves all scans but the first; writes the graph's poses, and per edge C^-1 and
   * C^-1 D about the world's origin in PCL's order x, y, z, turns about x, z, y. Fewer than
   * 2 vertices: PCL_ERROR, and nothing happens. \throws BadArgument one of options()
   * breaks its rule, a vertex with pairs has no cloud, or an index is not in its cloud */
  void
  compute();

  /** \return what the last compute() came to; links in the order of the graph's edges */
  const GraphSlamResult&
  result() const
  {
    return result_;
  }

  /** \throws BadArgument there is no cloud, here and below */
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

/** \brief (x, y, z, roll, pitch, yaw) of a pose as PCL's LUM holds it. */
Eigen::Matrix<float, 6, 1>
lumPose(const Eigen::Isometry3d& pose);

/** \brief C^-1 and C^-1 D about the world's origin, as PCL's LUM keeps them per edge: in
 * the order x, y, z, turns about x, z, y. */
void
lumEdge(const LinkReport& link,
        Eigen::Matrix<float, 6, 6>& information,
        Eigen::Matrix<float, 6, 1>& moment);

} // namespace pcl6d

#include <pcl6d/graph_relaxation/pcl/impl/lum.hpp>
PCL6D_DECLARE_INSTANCES(pcl6d::LUM)
