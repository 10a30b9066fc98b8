// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "doctor/limited_run.h"

#include <pcl/memory.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/types.h>

#include <Eigen/Geometry>

#include <optional>
#include <string>

namespace pcl6d::app {

/** \brief The classes that are compared. */
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

/** \return whether it is one of PCL's */
bool
isPcl(RegistrationClass method);

/** \return whether it takes cells of a grid instead of pairs */
bool
isNdt(RegistrationClass method);

/** \return whether it is of points and planes, and wants normals */
bool
wantsNormals(RegistrationClass method);

/** \brief What is set on an object; the rest is as its constructor leaves it. */
struct ClassSettings {
  std::optional<double> max_distance; ///< [m]
  std::optional<double> resolution;   ///< [m] side of a cell
  std::optional<int> iterations;
  std::optional<double>
      at_rest;      ///< [m] a step no longer ends it, in the class's own unit
  double reach = 1; ///< [m] with at_rest: from the middle of the cloud, for turns
};

/** \brief What a class gets. */
struct ClassInput {
  pcl::PointCloud<pcl::PointNormal>::Ptr source, target;
  pcl::shared_ptr<pcl::Indices> indices; ///< null: not set
  Eigen::Isometry3d guess = Eigen::Isometry3d::Identity();
};

/** \brief What a class made of it, as its user sees it. */
struct ClassOutcome {
  RunEnd end = RunEnd::kDone;
  std::string words; ///< how it ended if not kDone
  std::string said;  ///< what it printed
  std::string stage; ///< the call that did not come back
  bool converged = false;
  std::string state;     ///< why it stopped, in the words of the class; may be empty
  bool at_limit = false; ///< it stopped at the iteration limit
  int iterations = 0;
  int limit = 0;
  double fitness = 0; ///< [m^2] getFitnessScore(); NaN: none
  double seconds = 0; ///< of align()
  bool is_rigid = false;
  /** T_target_source in the coordinates of the input, if it is_rigid */
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

// One function per family, each in a file of its own as PCL's templates compile long. They
// fill what a run in its own process can tell, and throw what the class throws.
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
