// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/oriented_points.h>

#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Turns about the z axis of an object's frame after which it looks the same.
 * \ingroup object_localization */
struct ObjectSymmetry {
  int turns = 1; ///< 1: none but the full turn; n: by 1/n of a turn; 0: round, any turn

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

/** \return how far a surface is from itself after such a turn [m], in the mean: about
 * half the spacing of its points if it has the symmetry */
double
symmetryError(const OrientedPoints& surface, const ObjectSymmetry& symmetry);

} // namespace pcl6d
