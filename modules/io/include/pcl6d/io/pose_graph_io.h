// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/pose_graph.h>

#include <filesystem>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Reads a pose graph; the first word of each line tells the format:
 *
 * - g2o: `VERTEX_SE3:QUAT id x y z qx qy qz qw`, `EDGE_SE3:QUAT from to` + the same 7
 *   numbers + the upper triangle of the information matrix (21), whose rotation is the
 *   vector part of the quaternion; `FIX id ...`, which only chooses the frame, is
 *   checked and otherwise ignored.
 * - TORO: `VERTEX3 id x y z roll pitch yaw`, `EDGE3 from to x y z roll pitch yaw` + 21,
 *   whose rotation is in radians.
 *
 * Information becomes that of PoseLink: with e = (t, 2 vec(q)), q.w >= 0, of the error
 * pose, chi2 = e^T information e is that of the file. Ids may be any whole numbers; the
 * poses have the order of the file, and the ids are kept unless they are 0, 1, ... .
 * Empty lines and lines that start with # are skipped.
 *
 * A file without vertices gets poses in the order of the ids: along the links i -> i+1
 * from the identity if all of them are there, else along a tree of links from the first
 * pose of each component, at the identity.
 *
 * \throws IoFailed naming file, line, value and rule: unreadable, no pose, an unknown
 * word, wrong number of numbers, text where a number belongs, not finite, a quaternion
 * that is none, an id given twice, a link to a vertex that does not exist or to itself,
 * information with a fault (see informationFault(); what its tolerances let
 * pass is repaired), links that add up to a position that is not finite \ingroup io */
PoseGraph
readPoseGraph(const std::filesystem::path& path);

/** \brief Writes g2o rows with 17 digits, atomically. Positions and information come
 * back to the last bit, rotations within a few ulp. \throws BadArgument what
 * readPoseGraph() refuses: no pose, not one id per pose, an id given twice, a link to no
 * pose or to itself, what is not finite or no rigid motion, information with a fault (see
 * informationFault()); nothing is written then */
void
writePoseGraphG2o(const std::filesystem::path& path, const PoseGraph& graph);

/** \brief Writes TORO rows in the same way. */
void
writePoseGraphToro(const std::filesystem::path& path, const PoseGraph& graph);

/** \brief The formats of pose graphs. kAuto, for files to be written: kToro if the extension
 * is .graph or .toro, whatever its case, else kG2o. */
enum class PoseGraphFormat { kAuto, kG2o, kToro };

/** \return the format called "auto", "g2o" or "toro" \throws BadArgument another name */
PoseGraphFormat
poseGraphFormatFromName(const std::string& name);

/** \return the name of the format */
std::string
toString(PoseGraphFormat format);

/** \return the format in which a file is to be written, not kAuto */
PoseGraphFormat
formatToWrite(const std::filesystem::path& path, PoseGraphFormat format);

/** \brief Writes a graph in a format. \throws BadArgument, IoFailed as
 * writePoseGraphG2o() */
void
writePoseGraph(const std::filesystem::path& path,
               const PoseGraph& graph,
               PoseGraphFormat format = PoseGraphFormat::kAuto);

} // namespace pcl6d
