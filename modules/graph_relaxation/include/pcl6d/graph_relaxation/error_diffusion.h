// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/status.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <string>
#include <vector>

/** \file
 * Error diffusion (book 5.1.3): what is left open when a loop closes is spread over its
 * poses by weights from 0, the first scan of the loop, to 1, its last. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief How the error of a loop is spread. */
enum class LoopClosing {
  kElch,    ///< over the whole graph, by the costs of its edges
  kUniform, ///< over the scans from first to last, each step the same
  kPath,    ///< over the scans from first to last, by the length of the path
  kNone     ///< not at all
};

/** \return elch, uniform, path, none */
std::vector<std::string>
loopClosingNames();
/** \throws BadArgument no such name; the message lists all */
LoopClosing
loopClosingFromName(const std::string& name);
const char*
toString(LoopClosing method);

/** \brief One number for each of x, y, z in the axes of the world, and one for the
 * rotation. */
using PerDimension = Eigen::Vector4d;

/** \brief Two scans that were matched, and how loose that match is: the error that an edge
 * takes is in proportion to its cost. */
struct LoopEdge {
  std::size_t a = 0; ///< place among the poses
  std::size_t b = 0;
  PerDimension cost = PerDimension::Ones(); ///< finite, >= 0; such as variances
};

/** \brief The cost of an edge from the covariance of its match: the variances of x, y, z
 * and the sum of those of the rotation.
 * \param[in] covariance in the order translation [m], rotation [rad], in the axes of the
 * world; any axes will do unless ErrorDiffusionOptions::per_axis is set
 * \throws BadArgument it is not finite, or a variance is negative */
PerDimension
costOfCovariance(const Eigen::Matrix<double, 6, 6>& covariance);

/** \brief A loop that was found: its last scan was matched again with its first. */
struct Loop {
  std::size_t first = 0; ///< place among the poses; this pose stays
  std::size_t last = 0;  ///< the pose that the match corrects
  Eigen::Isometry3d corrected_last =
      Eigen::Isometry3d::Identity();        ///< T_world_last after the match
  PerDimension cost = PerDimension::Ones(); ///< of the edge that closes the loop
};

/** \brief Knobs of error diffusion. */
struct ErrorDiffusionOptions {
  LoopClosing method = LoopClosing::kElch;
  bool per_axis =
      false; ///< of kElch: weights for x, y and z apart, as published, which
             ///< depend on how the axes of the world lie. false: one for all
             ///< three, from the mean of their costs
};

/** \brief What became of the poses. */
struct ErrorDiffusionResult {
  /** kOk: the loop is closed. kRankDeficient: so it is, but no edges join first and last,
   * and the weights are uniform. kDiverged: the loop is refused, because its closing
   * rotation is half a turn (within 1e-3 rad), which is no drift, or a corrected pose
   * would not be finite: poses as given */
  Status status = Status::kOk;
  std::vector<Eigen::Isometry3d> poses; ///< T_world_scan, corrected
  std::vector<PerDimension> weights;    ///< in [0, 1]; of closeLoops(): the last loop's
};

/** \brief Closes a loop.
 *
 * Positions and rotations are spread apart: t' = t + w (t_last' - t_last) for each axis,
 * R' = exp(w a) R with a the rotation vector of R_last' R_last^T, a rotation about axes
 * of the world. So the result does not depend on where the origin of the world is. (To
 * split the motion T_last' T_last^-1 into translation and rotation instead moves scans
 * 500 m from the origin by metres.) The first pose and all of weight 0 keep their bits;
 * the last gets those of corrected_last, whose rotation is made exact if digits are lost;
 * without motion nothing changes.
 *
 * kUniform and kPath take poses in their order: those beyond the last move with it, those
 * before the first stay. A path of length 0 counts as uniform. kElch moves all poses that
 * edges join to the loop: branches as the place where they leave it; others stay.
 * \param[in] poses T_world_scan [m]
 * \param[in] edges of kElch, without the one that closes this loop
 * \throws BadArgument a pose is not rigid, or a scan that does not exist, an edge from a
 * scan to itself, a cost that is negative or not finite, first = last
 * \note Source: J. Sprickerhof, A. Nüchter, K. Lingemann, J. Hertzberg, "An Explicit Loop
 * Closing Technique for 6D SLAM", ECMR 2009. */
ErrorDiffusionResult
closeLoop(const std::vector<Eigen::Isometry3d>& poses,
          const std::vector<LoopEdge>& edges,
          const Loop& loop,
          const ErrorDiffusionOptions& options = {});

/** \brief Closes loops one after the other, each with the closing edges of those before it.
 *
 * A match says how two scans lie to each other, not in the world: corrected_last counts
 * relative to the given pose of first, which may have moved when the loop's turn comes.
 * The last loop is closed exactly. Those before it are kept as well as their costs say, up
 * to what the rotation of a later one does: scans turn in place, not about each other.
 * \return the worst status: kDiverged if a loop was refused (the others are closed), then
 * kRankDeficient
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

/** \brief The same with steps in proportion to the distance of the positions; uniform if
 * that is 0 all the way. \throws BadArgument as closeLoop() */
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
 * Again and again the shortest path between two vertices that have weights, through such
 * that have none, gets its weights by its length; what then has none is a branch and gets
 * that of its root, or 0 if it has none. Several edges may join the same vertices. A cost
 * of 0 counts as 1e-12 of the smallest other. Equally short paths: the one with the edge
 * of the lowest place in the list. One pass over the graph, in which the distance of a
 * vertex can only shrink: 10 000 vertices with 30 000 edges take about a tenth of a
 * second.
 * \return the weights in [0, 1]; empty if no edges join first and last
 * \throws BadArgument as closeLoop() */
std::vector<double>
elchWeights(std::size_t num_vertices,
            const std::vector<WeightedEdge>& edges,
            std::size_t first,
            std::size_t last);

} // namespace pcl6d
