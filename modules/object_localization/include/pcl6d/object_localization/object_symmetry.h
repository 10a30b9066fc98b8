// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/oriented_points.h>

#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Rotational symmetry of an object about the z axis of its frame.
 * \ingroup object_localization */
struct ObjectSymmetry {
  int turns = 1; ///< 1: no symmetry; n: by 1/n of a turn; 0: round, by any angle

  bool
  isRound() const
  {
    return turns == 0;
  }
};

/** \param[in] name "none", "round", or "turn:2", "turn:4" ... up to "turn:64"
 * \throws BadArgument another name */
ObjectSymmetry
symmetryFromName(const std::string& name);

/** \return the name that symmetryFromName() knows */
std::string
toString(const ObjectSymmetry& symmetry);

/** \return mean distance [m] of a surface and its copy turned by the symmetry: about
 * half the spacing of its points if the surface has the symmetry */
double
symmetryError(const OrientedPoints& surface, const ObjectSymmetry& symmetry);

} // namespace pcl6d
