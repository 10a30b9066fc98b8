// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/plane_minimiser.h>
#include <pcl6d/registration/rigid_minimiser.h>

#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief What ICP minimises over its pairs. */
enum class Metric {
  kPoint, ///< distance of points (Besl, McKay 1992)
  kPlane, ///< distance of source points to the planes at their partners (Chen, Medioni
          ///< 1992); needs normals of the target
  kGicp   ///< distance of planes (A. Segal, D. Haehnel, S. Thrun, "Generalized-ICP",
          ///< RSS 2009); needs normals of both
};

/** \brief How much a pair counts by its residual r, s being the scale (MAD) of all. */
enum class RobustKernel {
  kNone,        ///< 1
  kHuber,       ///< 1 up to 1.345 s, then 1.345 s / r
  kCauchy,      ///< 1 / (1 + (r / 2.385 s)^2)
  kGemanMcClure ///< 1 / (1 + (r / s)^2)^2, s doubled
};

/** \return point, plane, gicp */
std::vector<std::string>
metricNames();
/** \throws BadArgument no such name; the message lists all */
Metric
metricFromName(const std::string& name);
const char*
toString(Metric metric);

/** \return none, huber, cauchy, geman-mcclure */
std::vector<std::string>
robustKernelNames();
/** \throws BadArgument no such name; the message lists all */
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
  double gicp_epsilon =
      1e-3; ///< variance across a plane over that along it, of kGicp; in
            ///< (0, 1]
  /** of kGicp: pairs whose normals point apart do not count, such as those of the two
   * faces of a wall; for normals that point to the scanner, as estimateNormals() makes */
  bool facing_normals = false;
  /** of kPlane: the normal of a pair is the sum of both of its points', and its lever their
   * middle, so that curved surfaces glide into place (Rusinkiewicz, "A symmetric objective
   * function for ICP", SIGGRAPH 2019); needs source normals */
  bool symmetric = false;
  /** then, whether a normal of the source is turned towards that of its partner */
  bool align_normals = true;
  int max_iterations = 100;      ///< > 0
  double max_distance = 0.25;    ///< [m] farther pairs are dropped; > 0
  double max_distance_start = 0; ///< [m] the limit at the start, which then shrinks to
                                 ///< max_distance; 0: max_distance from the start
  double distance_decay = 0.9;   ///< the limit's factor per iteration; in (0, 1)
  int shrinking_stride =
      1; ///< while the limit shrinks, only every n-th source point is
         ///< looked at, which is enough to come near; > 0
  RobustKernel robust = RobustKernel::kNone;
  /** of kPoint: the source is scaled, too, by similarityByQuaternion() in place of the
   * minimiser; for what was not measured in one unit, as scans of one scanner are */
  bool estimate_scale = false;
  double max_scale =
      2; ///< a scale above it, or below its inverse, is kDiverged: a source
         ///< that shrinks comes ever nearer to the target; > 1
  double kept_share = 1; ///< trimmed ICP (Chetverikov 2002): only the closest of the
                         ///< pairs count; in (0, 1]
  double translation_epsilon = 1e-4; ///< [m] stop at a step no longer ...
  double rotation_epsilon = 1e-5;    ///< [rad] ... that also turns no more (and scales
                                     ///< by no larger a share); >= 0
  /** stop also when the mean squared distance of the pairs changes by a smaller share; 0:
   * never, the motion decides. In [0, 1) */
  double error_epsilon = 0;
  bool remember_neighbours = true; ///< false: SearchMemory::kNeighbours counts as kNone
  unsigned int num_threads = 0;    ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

} // namespace pcl6d
