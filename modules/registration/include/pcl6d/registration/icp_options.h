// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/plane_minimiser.h>
#include <pcl6d/registration/rigid_minimiser.h>

#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Error metric that ICP minimises over its pairs. */
enum class Metric {
  kPoint, ///< distance of points (Besl, McKay 1992)
  kPlane, ///< distance of source points to the planes at their partners (Chen, Medioni
          ///< 1992); needs normals of the target
  kGicp   ///< distance of planes (A. Segal, D. Haehnel, S. Thrun, "Generalized-ICP",
          ///< RSS 2009); needs normals of both
};

/** \brief Weight of a pair by its residual r; s: scale (MAD) of the residuals. */
enum class RobustKernel {
  kNone,        ///< 1
  kHuber,       ///< 1 up to 1.345 s, then 1.345 s / r
  kCauchy,      ///< 1 / (1 + (r / 2.385 s)^2)
  kGemanMcClure ///< 1 / (1 + (r / s)^2)^2, s doubled
};

/** \return point, plane, gicp */
std::vector<std::string>
metricNames();
/** \throws BadArgument unknown name; the message lists the known names */
Metric
metricFromName(const std::string& name);
const char*
toString(Metric metric);

/** \return none, huber, cauchy, geman-mcclure */
std::vector<std::string>
robustKernelNames();
/** \throws BadArgument unknown name; the message lists the known names */
RobustKernel
robustKernelFromName(const std::string& name);
const char*
toString(RobustKernel kernel);

/** \return the weight of a residual \param[in] residual >= 0, in units of the scale */
double
robustWeight(RobustKernel kernel, double residual);

/** \brief Knobs of ICP. Defaults suit scans with 1 cm to 10 cm point spacing. */
struct IcpOptions {
  Metric metric = Metric::kPoint;
  RigidMinimiser minimiser = minimiseByQuaternion;   ///< of the metric kPoint
  PlaneMinimiser plane_minimiser = planeStepByHelix; ///< of the metrics with normals
  double gicp_epsilon = 1e-3; ///< of kGicp: variance across a plane over the variance
                              ///< along it; in (0, 1]
  /** of kGicp: leaves out pairs of opposite normals, on the two faces of a wall for example; for
   * normals that point to the scanner, see estimateNormals() */
  bool facing_normals = false;
  /** of kPlane: the normal of a pair is the sum of both points' normals, and its lever their
   * middle: curved surfaces glide into place (Rusinkiewicz, "A symmetric objective function for
   * ICP", SIGGRAPH 2019); needs source normals */
  bool symmetric = false;
  /** with symmetric: whether a normal of the source is turned towards its partner's normal */
  bool align_normals = true;
  int max_iterations = 100;      ///< > 0
  double max_distance = 0.25;    ///< [m] farther pairs are dropped; > 0
  double max_distance_start = 0; ///< [m] the limit at the start, shrinking to
                                 ///< max_distance; 0: max_distance from the start
  double distance_decay = 0.9;   ///< the limit's factor per iteration; in (0, 1)
  int shrinking_stride = 1; ///< while the limit shrinks, only every n-th source point
                            ///< is used, enough for a rough pose; > 0
  RobustKernel robust = RobustKernel::kNone;
  /** of kPoint: the source is scaled, too, by similarityByQuaternion() in place of the minimiser;
   * for scans in different units; scans of one scanner have one unit */
  bool estimate_scale = false;
  double max_scale = 2;  ///< a scale above, or below its inverse, is kDiverged: a
                         ///< shrinking source comes ever nearer to the target; > 1
  double kept_share = 1; ///< trimmed ICP (Chetverikov 2002): only the closest of the
                         ///< pairs count; in (0, 1]
  double translation_epsilon = 1e-4; ///< [m] stop at a step no longer ...
  double rotation_epsilon = 1e-5;    ///< [rad] ... and a turn no larger (and a change
                                     ///< of scale no larger); >= 0
  /** stop also when the mean squared distance of the pairs changes by a smaller share; 0:
   * never, the motion decides. In [0, 1) */
  double error_epsilon = 0;
  bool remember_neighbours = true; ///< false: SearchMemory::kNeighbours counts as kNone
  unsigned int num_threads = 0;    ///< 0: a thread per core; never changes the result
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

} // namespace pcl6d
