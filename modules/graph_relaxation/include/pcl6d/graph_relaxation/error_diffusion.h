// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/status.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <string>
#include <vector>

/** \file Error diffusion (book 5.1.3): the closing error of a loop is distributed over its
 * poses by weights from 0 at the first scan of the loop to 1 at the last. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief How the error of a loop is distributed. */
enum class LoopClosing {
  kElch,    ///< over the whole graph, by the costs of its edges
  kUniform, ///< over the scans from first to last, in equal steps
  kPath,    ///< over the scans from first to last, by the length of the path
  kNone     ///< not at all
};

/** \return elch, uniform, path, none */
std::vector<std::string>
loopClosingNames();
/** \throws BadArgument an unknown name; the message lists the valid names */
LoopClosing
loopClosingFromName(const std::string& name);
const char*
toString(LoopClosing method);

/** \brief One value for each of x, y, z in the world axes, and one for the rotation. */
using PerDimension = Eigen::Vector4d;

/** \brief A match of two scans and its cost; an edge takes a part of the error in proportion to
 * its cost. */
struct LoopEdge {
  std::size_t a = 0; ///< index of a pose
  std::size_t b = 0;
  PerDimension cost = PerDimension::Ones(); ///< finite, >= 0; such as variances
};

/** \brief The cost of an edge from the covariance of its match: the variances of x, y, z and
 * the sum of the variances of the rotation.
 * \param[in] covariance in the order translation [m], rotation [rad], in the world axes; any
 * axes will do unless ErrorDiffusionOptions::per_axis is set
 * \throws BadArgument not finite, or a negative variance */
PerDimension
costOfCovariance(const Eigen::Matrix<double, 6, 6>& covariance);

/** \brief A detected loop: the last scan was matched again with the first. */
struct Loop {
  std::size_t first = 0; ///< index of the pose that stays fixed
  std::size_t last = 0;  ///< index of the pose corrected by the match
  Eigen::Isometry3d corrected_last =
      Eigen::Isometry3d::Identity();        ///< T_world_last after the match
  PerDimension cost = PerDimension::Ones(); ///< of the closing edge
};

/** \brief Knobs of error diffusion. */
struct ErrorDiffusionOptions {
  LoopClosing method = LoopClosing::kElch;
  bool per_axis = false; ///< of kElch: separate weights for x, y and z, as
                         ///< published; the result then depends on the world axes.
                         ///< false: one weight, from the mean of the three costs
};

/** \brief Result of error diffusion. */
struct ErrorDiffusionResult {
  /** kOk: the loop is closed. kRankDeficient: the loop is closed, but with uniform weights, as
   * no edges connect first and last. kDiverged: the loop is rejected and the poses are the
   * input: the closing rotation is half a turn (within 1e-3 rad), too much for drift, or a
   * corrected pose would not be finite */
  Status status = Status::kOk;
  std::vector<Eigen::Isometry3d> poses; ///< T_world_scan, corrected
  std::vector<PerDimension> weights;    ///< in [0, 1]; of closeLoops(): the last loop's
};

/** \brief Closes a loop.
 *
 * Positions and rotations are distributed separately: t' = t + w (t_last' - t_last) for each
 * axis, R' = exp(w a) R with a the rotation vector of R_last' R_last^T, a rotation about world
 * axes. The result is therefore independent of the world origin. (Splitting the motion T_last'
 * T_last^-1 into translation and rotation would move scans 500 m from the origin by metres.)
 * The first pose and each pose of weight 0 keep their bits. The last pose gets the bits of
 * corrected_last, with an exact rotation if digits are lost. Without motion nothing changes.
 *
 * kUniform and kPath take poses in their order: poses after the last move with the last, poses
 * before the first stay. A path of length 0 counts as uniform. kElch moves every pose connected
 * with the loop by edges: a branch moves as its junction with the loop; disconnected poses stay.
 * \param[in] poses T_world_scan [m]
 * \param[in] edges of kElch, without the closing edge of this loop
 * \throws BadArgument a pose is not rigid, a scan index out of range, an edge from a scan to
 * itself, a negative or non-finite cost, first = last
 * \note Source: J. Sprickerhof, A. Nüchter, K. Lingemann, J. Hertzberg, "An Explicit Loop
 * Closing Technique for 6D SLAM", ECMR 2009. */
ErrorDiffusionResult
closeLoop(const std::vector<Eigen::Isometry3d>& poses,
          const std::vector<LoopEdge>& edges,
          const Loop& loop,
          const ErrorDiffusionOptions& options = {});

/** \brief Closes loops in sequence, each with the closing edges of the earlier loops.
 *
 * A match gives the relative pose of two scans, not a pose in the world: corrected_last counts
 * relative to the given pose of first, which earlier loops may have moved. The last loop is
 * closed exactly. Earlier loops stay closed as well as their costs allow, up to the effect of
 * the rotation of a later loop: scans turn in place, not about each other.
 * \return the worst status: kDiverged if a loop was rejected (the remaining loops are closed),
 * then kRankDeficient
 * \throws BadArgument as closeLoop(), before any loop is closed */
ErrorDiffusionResult
closeLoops(const std::vector<Eigen::Isometry3d>& poses,
           std::vector<LoopEdge> edges,
           const std::vector<Loop>& loops,
           const ErrorDiffusionOptions& options = {});

/** \brief Weights by index: 0 up to first, 1 from last, equal steps between. Loops may
 * run backwards. \throws BadArgument as closeLoop() */
std::vector<double>
uniformWeights(std::size_t num_poses, std::size_t first, std::size_t last);

/** \brief Weights by path length: steps in proportion to the distance between positions;
 * uniform if every distance is 0.
 * \throws BadArgument as closeLoop() */
std::vector<double>
pathWeights(const std::vector<Eigen::Isometry3d>& poses,
            std::size_t first,
            std::size_t last);

/** \brief An edge of a graph with one cost. */
struct WeightedEdge {
  std::size_t a = 0;
  std::size_t b = 0;
  double cost = 1; ///< finite, >= 0
};

/** \brief Weights in one dimension over a whole graph, by shortest paths.
 *
 * Repeatedly, the shortest path between two vertices with weights, through vertices without,
 * gets weights by its length. A vertex left without a weight is on a branch and gets the weight
 * of the branch's root, or 0 without such a root. Several edges may join two vertices. A cost
 * of 0 counts as 1e-12 of the smallest positive cost. Of equally short paths, the path with the
 * edge of the lowest index counts. One pass over the graph, in which the distance of a vertex
 * can only shrink: 10 000 vertices with 30 000 edges take about a tenth of a second.
 * \return the weights in [0, 1]; empty if no edges connect first and last
 * \throws BadArgument as closeLoop() */
std::vector<double>
elchWeights(std::size_t num_vertices,
            const std::vector<WeightedEdge>& edges,
            std::size_t first,
            std::size_t last);

} // namespace pcl6d
