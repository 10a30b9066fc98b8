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
 * pcl::registration::ELCH: clouds in world coordinates, of which the last sees again what
 * the first has seen.
 *
 * compute() registers the end of the loop with its start, both with their neighbours, and
 * spreads the motion over the graph. Then the clouds are moved, as in PCL, and each vertex
 * holds the motion that moved its own.
 *
 * Differences:
 * - setModifyInputClouds(false) leaves the caller's clouds as they are: vertices then hold
 *   new ones;
 * - clouds turn about the place of their scanner, by default their centroid, so that the
 *   result does not depend on the origin of the world (PCL: about the origin);
 * - edges cost what setEdgeCovariance() says of some of them or, if it has said nothing of
 *   any, their length (PCL: 1 each); edges without a covariance among others with one
 *   count as the mean of those;
 * - a registration that fails closes nothing, see status() (PCL: closes the loop by
 *   whatever came out); one of ours that ended at its iteration limit does close it;
 * - calls without a meaning throw BadArgument (PCL: PCL_ERROR, or undefined), and the end
 *   of the loop must be set;
 * - LoopGraph has edges with a property, and so is another type than PCL's;
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
 * Closing Technique for 6D SLAM", ECMR 2009. \ingroup graph_relaxation */
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
    PointCloudPtr cloud; ///< in world coordinates [m]; after compute() the moved one
    Eigen::Affine3f transform = Eigen::Affine3f::Identity(); ///< of the last compute()
    /** Where the scanner stood [m]; the centroid of the cloud unless given. */
    std::optional<Eigen::Vector3d> position;
  };

  /** \brief Two scans that were matched. */
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

  /** \brief Adds a scan, joined to the one before.
   * \param[in] cloud in world coordinates [m] \throws BadArgument it is null */
  void
  addPointCloud(const PointCloudPtr& cloud);

  /** \brief The same with the place of the scanner in the world [m].
   * \throws BadArgument it is not finite */
  void
  addPointCloud(const PointCloudPtr& cloud, const Eigen::Vector3d& position);

  LoopGraphPtr
  getLoopGraph() const
  {
    return loop_graph_;
  }

  /** \throws BadArgument it is null */
  void
  setLoopGraph(const LoopGraphPtr& loop_graph);

  /** \brief How precisely two scans were matched; the looser, the more of the error their
   * edge takes. \param[in] covariance translation [m], rotation [rad]; in the axes of the
   * world, of importance only for setWeightsPerAxis()
   * \throws BadArgument there is no such edge, or costOfCovariance() refuses */
  void
  setEdgeCovariance(VertexId a, VertexId b, const Covariance& covariance);

  /** \brief Weights for x, y and z apart (ErrorDiffusionOptions::per_axis); false unless
   * set. */
  void
  setWeightsPerAxis(bool per_axis)
  {
    options_.per_axis = per_axis;
  }

  /** \brief The scan that starts the loop, which stays; 0 unless set. */
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

  /** \brief The scan that ends the loop; must be set. */
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

  /** \brief What registers the end of the loop with its start; ICP6D without a limit of
   * the distance unless set. \throws BadArgument it is null */
  void
  setReg(const RegistrationPtr& reg);
  RegistrationPtr
  getReg() const
  {
    return reg_;
  }

  /** \return the motion of the last scan that closes the loop: set, or that of the last
   * compute(); the identity before */
  Eigen::Matrix4f
  getLoopTransform() const
  {
    return loop_transform_;
  }

  /** \brief Gives that motion, in the world; nothing is registered from now on.
   * \throws BadArgument it is not rigid */
  void
  setLoopTransform(const Eigen::Matrix4f& loop_transform);

  /** \brief Whether the points in the caller's clouds are moved, as PCL does; true unless
   * set. Else the moved clouds are new ones, in the graph. */
  void
  setModifyInputClouds(bool modify)
  {
    modify_input_clouds_ = modify;
  }

  /** \brief Closes the loop between start and end, and joins them by an edge.
   * \throws BadArgument start and end are no two scans of the graph, a vertex has no cloud,
   * or one without a finite point has no position; nothing has changed then */
  void
  compute();

  /** \return of the last compute(): kOk, the loop is closed; kRankDeficient, so it is, but
   * no edges join start and end, and weights are by index; kMaxIterations, so it is, but by an
   * ICP6D that ended at its iteration limit; kDiverged, nothing has changed:
   * the registration did not converge, or it turns the scan by half a turn. kTooFewPairs
   * before the first compute(). ICP6D says more in its result() */
  Status
  status() const
  {
    return status_;
  }

  /** \return the motions of the last compute() in double, one per vertex; empty if it has
   * changed nothing */
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
  bool is_at_rest_ = true; ///< the registration that gave the motion
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
