// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "doctor/peers/limited_run.h"

#include <pcl/memory.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/types.h>

#include <Eigen/Geometry>

#include <optional>
#include <string>

namespace pcl6d::app {

/** \brief The compared registration classes. */
enum class RegistrationClass {
  kPclIcp,
  kPclIcpWithNormals,
  kPclGicp,
  kPclNdt,
  kIcp6d,
  kIcp6dWithNormals,
  kGicp6d,
  kNdt6d
};

/** \return "pcl::IterativeClosestPoint", "pcl6d::ICP6D", ... */
const char*
toString(RegistrationClass method);

/** \return whether the class is from PCL */
bool
isPcl(RegistrationClass method);

/** \return whether the class uses cells of a grid instead of pairs */
bool
isNdt(RegistrationClass method);

/** \return whether the class needs normals, as with point-to-plane */
bool
wantsNormals(RegistrationClass method);

/** \brief Parameters set on an object; unset parameters keep the defaults of the class. */
struct ClassSettings {
  std::optional<double> max_distance; ///< [m]
  std::optional<double> resolution;   ///< [m] side of a cell
  std::optional<int> iterations;
  std::optional<double> at_rest; ///< [m] stop at smaller steps, in the class's own unit
  double reach = 1; ///< [m] with at_rest: from the middle of the cloud, for turns
};

/** \brief Input of a class. */
struct ClassInput {
  pcl::PointCloud<pcl::PointNormal>::Ptr source, target;
  pcl::shared_ptr<pcl::Indices> indices; ///< null: not set
  Eigen::Isometry3d guess = Eigen::Isometry3d::Identity();
};

/** \brief Outcome of a class, as seen by its user. */
struct ClassOutcome {
  RunEnd end = RunEnd::kDone;
  std::string words; ///< reason of the end if not kDone
  std::string said;  ///< what it printed
  std::string stage; ///< last stage entered
  bool converged = false;
  std::string state; ///< reason for stopping, in the words of the class; may be empty
  bool at_limit = false; ///< stopped at the iteration limit
  int iterations = 0;
  int limit = 0;
  double fitness = 0; ///< [m^2] getFitnessScore(); NaN: none
  double seconds = 0; ///< of align()
  bool is_rigid = false;
  /** T_target_source in the coordinates of the input, if is_rigid */
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();

  bool
  hasPose() const
  {
    return end == RunEnd::kDone && is_rigid;
  }
};

/** \brief One align() in a process of its own. */
ClassOutcome
runClass(RegistrationClass method,
         const ClassSettings& settings,
         const ClassInput& input,
         double seconds,
         const Interrupt& interrupt);

// One function per family, each in a file of its own, as PCL's templates compile
// slowly. Each function fills the fields known inside the run's process, and passes on
// exceptions of the class.
void
alignPclIcp(const ClassSettings& settings, const ClassInput& input, ClassOutcome& out);
void
alignPclIcpWithNormals(const ClassSettings& settings,
                       const ClassInput& input,
                       ClassOutcome& out);
void
alignPclGicp(const ClassSettings& settings, const ClassInput& input, ClassOutcome& out);
void
alignPclNdt(const ClassSettings& settings, const ClassInput& input, ClassOutcome& out);
void
alignOurs(RegistrationClass method,
          const ClassSettings& settings,
          const ClassInput& input,
          ClassOutcome& out);

} // namespace pcl6d::app
