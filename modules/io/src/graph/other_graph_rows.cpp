// SPDX-License-Identifier: BSD-3-Clause
#include "graph/other_graph_rows.h"

#include <algorithm>
#include <array>

namespace pcl6d::io {

namespace {
/** Words of g2o without a meaning for a graph of poses and links. */
constexpr std::array<std::string_view, 5> kOtherWords = {"VERTEX_POINT_XYZ",
                                                         "VERTEX_XY",
                                                         "EDGE_SE2_XY",
                                                         "EDGE_SE3_TRACKUVD",
                                                         "VERTEX_CAM"};
} // namespace

void
failAtWord(const std::filesystem::path& path,
           const text::Lines& lines,
           std::string_view word)
{
  const bool is_known =
      std::find(kOtherWords.begin(), kOtherWords.end(), word) != kOtherWords.end();
  text::failAt(path,
               lines.number(),
               text::quoted(word) +
                   (is_known
                        ? " is not a pose, link or constraint; --skip-unknown leaves "
                          "unknown lines out"
                        : " starts no line of a 3D pose graph; known are "
                          "VERTEX_SE3:QUAT, EDGE_SE3:QUAT, VERTEX_SE2, EDGE_SE2, FIX "
                          "(g2o), VERTEX3, EDGE3 (TORO)"));
}

} // namespace pcl6d::io
