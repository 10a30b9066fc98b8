// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/graph_relaxation/error_diffusion.h>

#include <pcl/pcl_base.h>
#include <pcl/registration/boost_graph.h>
#include <pcl/registration/registration.h>

#include <optional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Explicit Loop Closing Heuristic (book 5.1.3) as a drop-in for
 * pcl::registration::ELCH: clouds in world coordinates; the last cloud revisits the first.
 *
 * compute() registers the end of the loop with its start, both with their neighbours, and
 * distributes the motion over the graph. Then the clouds are moved, as in PCL, and each vertex
 * stores the motion of its cloud.
 *
 * Differences:
 * - setModifyInputClouds(false) leaves the caller's clouds unchanged: vertices then have new
 *   clouds;
 * - clouds turn about their scanner position, by default their centroid, so that the result
 *   does not depend on the world origin (PCL: about the origin);
 * - edges cost their covariance from setEdgeCovariance() or, if no edge has a covariance,
 *   their length (PCL: 1 each); an edge without a covariance counts as the mean of the edges
 *   with a covariance;
 * - a failed registration closes no loop, see status() (PCL: closes the loop by any result);
 *   an ICP6D that ended at its iteration limit does close the loop;
 * - meaningless calls throw BadArgument (PCL: PCL_ERROR, or undefined), and the end of the
 *   loop must be set;
 * - LoopGraph has edges with a property, and is therefore a different type from PCL's;
 * - unless set, getReg() is an ICP6D, not a pcl::IterativeClosestPoint.
 * \code
 * pcl6d::ELCH<pcl::PointXYZ> elch;
 * for (const auto& cloud : clouds)
 *   elch.addPointCloud(cloud);
 * elch.setLoopStart(0);
 * elch.setLoopEnd(clouds.size() - 1);
 * elch.compute();
 * if (elch.status() == pcl6d::Status::kOk)
 *   map += *(*elch.getLoopGraph())[3].cloud;
 * \endcode
 * \note Source: J. Sprickerhof, A. Nüchter, K. Lingemann, J. Hertzberg, "An Explicit Loop
 * Closing Technique for 6D SLAM", ECMR 2009.
 * \ingroup graph_relaxation */
template <typename PointT>
class ELCH : public pcl::PCLBase<PointT> {
public:
  using Ptr = pcl::shared_ptr<ELCH<PointT>>;
  using ConstPtr = pcl::shared_ptr<const ELCH<PointT>>;

  using PointCloud = pcl::PointCloud<PointT>;
  using PointCloudPtr = typename PointCloud::Ptr;
  using PointCloudConstPtr = typename PointCloud::ConstPtr;

  using Covariance = Eigen::Matrix<double, 6, 6>;

  /** \brief A scan. */
  struct Vertex {
    PointCloudPtr cloud; ///< in world coordinates [m]; after compute() the moved cloud
    Eigen::Affine3f transform = Eigen::Affine3f::Identity(); ///< of the last compute()
    /** Position of the scanner [m]; the centroid of the cloud unless given. */
    std::optional<Eigen::Vector3d> position;
  };

  /** \brief A match of two scans. */
  struct Edge {
    std::optional<Covariance> covariance; ///< of the match, see setEdgeCovariance()
  };

  using LoopGraph = boost::
      adjacency_list<boost::listS, boost::eigen_vecS, boost::undirectedS, Vertex, Edge>;
  using LoopGraphPtr = pcl::shared_ptr<LoopGraph>;
  using VertexId = typename boost::graph_traits<LoopGraph>::vertex_descriptor;

  using Registration = pcl::Registration<PointT, PointT>;
  using RegistrationPtr = typename Registration::Ptr;
  using RegistrationConstPtr = typename Registration::ConstPtr;

  /** \brief An empty graph, ICP6D for the loop. */
  ELCH();

  /** \brief Adds a scan, joined to the previous scan.
   * \param[in] cloud in world coordinates [m]
   * \throws BadArgument null */
  void
  addPointCloud(const PointCloudPtr& cloud);

  /** \brief Adds a scan with its scanner position in the world [m].
   * \throws BadArgument position not finite */
  void
  addPointCloud(const PointCloudPtr& cloud, const Eigen::Vector3d& position);

  LoopGraphPtr
  getLoopGraph() const
  {
    return loop_graph_;
  }

  /** \throws BadArgument null */
  void
  setLoopGraph(const LoopGraphPtr& loop_graph);

  /** \brief Sets the covariance of a match; the larger, the more of the error its edge takes.
   * \param[in] covariance translation [m], rotation [rad]; in the world axes, relevant only for
   * setWeightsPerAxis()
   * \throws BadArgument an unknown edge, or an invalid covariance, see costOfCovariance() */
  void
  setEdgeCovariance(VertexId a, VertexId b, const Covariance& covariance);

  /** \brief Weights for x, y and z apart (ErrorDiffusionOptions::per_axis); false unless
   * set. */
  void
  setWeightsPerAxis(bool per_axis)
  {
    options_.per_axis = per_axis;
  }

  /** \brief The first scan of the loop, which stays fixed; 0 unless set. */
  void
  setLoopStart(VertexId loop_start)
  {
    loop_start_ = loop_start;
  }
  VertexId
  getLoopStart() const
  {
    return loop_start_;
  }

  /** \brief The last scan of the loop; must be set. */
  void
  setLoopEnd(VertexId loop_end)
  {
    loop_end_ = loop_end;
  }
  VertexId
  getLoopEnd() const
  {
    return loop_end_;
  }

  /** \brief The registration of the end of the loop with its start; ICP6D without a limit of
   * the distance unless set.
   * \throws BadArgument null */
  void
  setReg(const RegistrationPtr& reg);
  RegistrationPtr
  getReg() const
  {
    return reg_;
  }

  /** \return the motion of the last scan that closes the loop: set, or from the last compute();
   * identity before */
  Eigen::Matrix4f
  getLoopTransform() const
  {
    return loop_transform_;
  }

  /** \brief Sets the closing motion, in the world; no registration runs from now on.
   * \throws BadArgument not rigid */
  void
  setLoopTransform(const Eigen::Matrix4f& loop_transform);

  /** \brief Whether the points in the caller's clouds are moved, as in PCL; true unless set.
   * Else the graph gets new, moved clouds. */
  void
  setModifyInputClouds(bool modify)
  {
    modify_input_clouds_ = modify;
  }

  /** \brief Closes the loop between start and end, and joins them by an edge.
   * \throws BadArgument start and end are not two scans of the graph, a vertex has no cloud, or
   * a cloud without a finite point has no position; the graph is unchanged then */
  void
  compute();

  /** \return the status of the last compute(). kOk: the loop is closed. kRankDeficient: closed,
   * but with weights by index, as no edges connect start and end. kMaxIterations: closed by an
   * ICP6D that ended at its iteration limit. kDiverged: no change; the registration did not
   * converge, or turns the scan by half a turn. kTooFewPairs: before the first compute(). See
   * ICP6D's result() for details */
  Status
  status() const
  {
    return status_;
  }

  /** \return the motions of the last compute() in double, one per vertex; empty without a change */
  const std::vector<Eigen::Isometry3d>&
  corrections() const
  {
    return corrections_;
  }

private:
  void
  requireScans() const;
  PointCloudPtr
  withNeighbours(VertexId vertex) const;
  std::optional<Eigen::Matrix4f>
  loopMotion();
  std::vector<Eigen::Isometry3d>
  positions() const;
  std::vector<LoopEdge>
  edgesWithCosts(const std::vector<Eigen::Isometry3d>& poses) const;
  void
  moveScan(Vertex& vertex, const Eigen::Isometry3d& correction);

  LoopGraphPtr loop_graph_;
  VertexId loop_start_ = 0;
  VertexId loop_end_ = 0;
  RegistrationPtr reg_;
  Eigen::Matrix4f loop_transform_ = Eigen::Matrix4f::Identity();
  bool register_loop_ = true;
  bool modify_input_clouds_ = true;
  bool is_at_rest_ = true; ///< the registration of the closing motion converged
  ErrorDiffusionOptions options_;
  Status status_ = Status::kTooFewPairs;
  std::vector<Eigen::Isometry3d> corrections_;

public:
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

} // namespace pcl6d
#include <pcl6d/graph_relaxation/pcl/impl/elch.hpp>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_INSTANCES(ELCH)
} // namespace pcl6d
