// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/slam6d/slam6d_result.h>

#include <cstddef>

/** \file What is done where the verdict on a map says that parts of it are elsewhere. */
namespace pcl6d::slam6d {

/** \return whether good links do not tie all matched scans to each other, though not for want of
 * any: a map of two parts, one of which was matched at a wrong place */
bool
hasUntied(const Slam6DResult& result);

/** \brief The part that is not tied to the first scan is lost.
 * \param[in] keeps so many first scans stay as they are: those of an earlier run */
void
loosen(std::size_t keeps, Slam6DResult& result);

/** \return whether fewer scans are lost or untied than before */
bool
isBetterTied(const Slam6DResult& now, const Slam6DResult& before);

/** \brief Scans that were not lost were matched where they were before. */
void
keepMatchedPoses(const Slam6DResult& before, Slam6DResult& now);

} // namespace pcl6d::slam6d
