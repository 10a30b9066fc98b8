// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/graph_constraints.h>
#include <pcl6d/common/pose_graph.h>

#include <filesystem>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Reads a pose graph; the first word of each line tells the format:
 *
 * - g2o: `VERTEX_SE3:QUAT id x y z qx qy qz qw`, `EDGE_SE3:QUAT from to` + 7 numbers of a pose
 * and 21 of the upper triangle of the information matrix, with the vector part of the
 * quaternion as rotation; `FIX id ...` (PoseGraphFile::fixed). `VERTEX_SE2`, `EDGE_SE2` lie in
 * the x-y plane. The information about z, roll and pitch, missing in the file, is copied from
 * x, y and yaw.
 * - g2o, constraints (PoseGraphFile::constraints): `PARAMS_SE3OFFSET id` + 7, the pose of a
 * sensor; `VERTEX_TRACKXYZ id x y z`, `EDGE_SE3_TRACKXYZ pose landmark offset x y z` + 6;
 * `EDGE_SE3_PRIOR pose offset` + 7 + 21, `EDGE_SE2_PRIOR` or `EDGE_PRIOR_SE2 pose x y yaw` + 6,
 * `EDGE_PRIOR_SE2_XY pose x y` + 3; `VERTEX_SWITCH id s`, `EDGE_SWITCH_PRIOR id s information`,
 * `EDGE_SE3_SWITCHABLE from to switch` + 7 + 21, `EDGE_SE2_SWITCHABLE` alike: links of the
 * graph with a switch. Sensor offsets are included in the measurements.
 * - TORO: `VERTEX3 id x y z roll pitch yaw`, `EDGE3 from to x y z roll pitch yaw` + 21,
 * rotation in radians.
 *
 * Information is converted to PoseLink's: with e = (t, 2 vec(q)), q.w >= 0, of the error pose,
 * chi2 = e^T information e equals the file's. Ids may be any whole numbers; poses keep the
 * order of the file, and ids are stored unless equal to 0, 1, ... . Empty lines and lines that
 * start with # are skipped.
 *
 * A file without vertices gets poses in the order of the ids: along the links i -> i+1 from the
 * identity if complete, else along a spanning tree of each component, with the component's
 * first pose at the identity.
 *
 * \throws IoFailed naming file, line, value and rule: unreadable, no pose, an unknown word,
 * wrong number of numbers, text where a number belongs, not finite, an invalid quaternion, a
 * repeated id, a link to an unknown vertex or from a vertex to itself, information with a fault
 * (see informationFault(); deviations within the tolerances are repaired), links that add up to
 * a position that is not finite \ingroup io */
PoseGraph
readPoseGraph(const std::filesystem::path& path);

/** \brief How a pose graph is read. */
struct PoseGraphReaderOptions {
  /** skip rows that are neither pose, link nor constraint, instead of throwing */
  bool skip_unknown = false;
};

/** \brief Content of a pose graph file. */
struct PoseGraphFile {
  PoseGraph graph;
  GraphConstraints constraints;     ///< also the poses of FIX; in the order of the file
  std::vector<std::string> skipped; ///< "3 lines VERTEX_XY", in the order of the file
};

/** \brief readPoseGraph() with constraints and fixed poses. */
PoseGraphFile
readPoseGraphFile(const std::filesystem::path& path,
                  const PoseGraphReaderOptions& options = {});

/** \brief Writes g2o rows with 17 digits, atomically. Positions and information come back to the
 * last bit, rotations within a few ulp. \throws BadArgument the conditions of readPoseGraph():
 * no pose, the numbers of ids and poses differ, a repeated id, a link to an unknown pose or
 * from a pose to itself, a value that is not finite or not a rigid motion, information with a
 * fault (see informationFault()); no file is written then */
void
writePoseGraphG2o(const std::filesystem::path& path, const PoseGraph& graph);

/** \brief Writes TORO rows with the precision of writePoseGraphG2o(). */
void
writePoseGraphToro(const std::filesystem::path& path, const PoseGraph& graph);

/** \brief The formats of pose graphs. kAuto, for writing: kToro for the extension .graph or
 * .toro, in any case, else kG2o. */
enum class PoseGraphFormat { kAuto, kG2o, kToro };

/** \return the format called "auto", "g2o" or "toro" \throws BadArgument another name */
PoseGraphFormat
poseGraphFormatFromName(const std::string& name);

/** \return the name of the format */
std::string
toString(PoseGraphFormat format);

/** \return the format to write, never kAuto */
PoseGraphFormat
formatToWrite(const std::filesystem::path& path, PoseGraphFormat format);

/** \brief Writes a graph, with constraints in g2o. TORO has no lines for constraints: FIX is
 * left out, further constraints are rejected. \throws BadArgument, IoFailed under the
 * conditions of writePoseGraphG2o() */
void
writePoseGraph(const std::filesystem::path& path,
               const PoseGraph& graph,
               PoseGraphFormat format = PoseGraphFormat::kAuto,
               const GraphConstraints& constraints = {});

} // namespace pcl6d
