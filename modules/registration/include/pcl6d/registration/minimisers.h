// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/linear_minimiser.h>

#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A point-to-point minimiser with its name on the command line. */
struct NamedMinimiser {
  std::string name;
  RigidMinimiser step;     ///< between two searches of an ICP; closed forms: minimise
  RigidMinimiser minimise; ///< for fixed pairs
};

/** \return svd, quaternion, orthonormal, dual-quaternion, scale-quaternion, helix,
 * small-angle, euler, quaternion-linear */
const std::vector<NamedMinimiser>&
namedMinimisers();

/** \return the names of namedMinimisers(), in that order */
std::vector<std::string>
minimiserNames();

/** \return the step of the named minimiser, for icp()
 * \throws BadArgument unknown name; the message lists the known names */
RigidMinimiser
minimiserFromName(const std::string& name);

} // namespace pcl6d
