// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

/** \file All targets: name, structure of the files, largest size [bytes]. Each name is that
 * of a function, of a folder in corpus/ and, behind `fuzz_`, of a program. */
#define PCL6D_FUZZ_TARGETS(X)                                                          \
  X(bag_mcap, kBytes, 8192)                                                            \
  X(bag_message, kBytes, 4096)                                                         \
  X(bag_ros, kBytes, 16384)                                                            \
  X(bin, kBytes, 4096)                                                                 \
  X(camera, kText, 4096)                                                               \
  X(cascade, kText, 8192)                                                              \
  X(config, kText, 1024)                                                               \
  X(control_points, kText, 2048)                                                       \
  X(csv, kText, 4096)                                                                  \
  X(e57, kBytes, 8192)                                                                 \
  X(frames, kText, 4096)                                                               \
  X(json, kText, 65536)                                                                \
  X(kitti, kBytes, 4096)                                                               \
  X(label_rules, kText, 8192)                                                          \
  X(las, kBytes, 8192)                                                                 \
  X(link_list, kText, 4096)                                                            \
  X(map_objects, kText, 8192)                                                          \
  X(natural_order, kText, 512)                                                         \
  X(numbers, kText, 128)                                                               \
  X(obj, kText, 4096)                                                                  \
  X(objects, kText, 8192)                                                              \
  X(pcd, kPcd, 8192)                                                                   \
  X(plan_csv, kText, 4096)                                                             \
  X(plan_geojson, kText, 65536)                                                        \
  X(plan_svg, kText, 65536)                                                            \
  X(planes, kText, 8192)                                                               \
  X(ply_mesh, kPly, 8192)                                                              \
  X(ply_scan, kPly, 8192)                                                              \
  X(point_list, kText, 4096)                                                           \
  X(polygon, kBytes, 256)                                                              \
  X(pose_graph, kText, 8192)                                                           \
  X(pts, kText, 4096)                                                                  \
  X(ptx, kText, 4096)                                                                  \
  X(query, kText, 512)                                                                 \
  X(range_lines, kText, 4096)                                                          \
  X(record_file, kRecordFile, 4096)                                                    \
  X(run_links, kText, 8192)                                                            \
  X(run_summary, kText, 32768)                                                         \
  X(scene, kText, 8192)                                                                \
  X(scan_targets, kText, 2048)                                                         \
  X(semantic_map, kText, 32768)                                                        \
  X(stamps, kText, 2048)                                                               \
  X(stereo_calibration, kText, 8192)                                                   \
  X(stl, kStl, 4096)                                                                   \
  X(suite, kText, 8192)                                                                \
  X(trajectory, kText, 4096)                                                           \
  X(uos, kText, 4096)                                                                  \
  X(uos_pose, kText, 1024)                                                             \
  X(uosr, kText, 4096)                                                                 \
  X(xyz, kText, 4096)

namespace pcl6d::fuzz {

#define PCL6D_FUZZ_DECLARE(name, structure, max_size)                                  \
  int name(const std::uint8_t* data, std::size_t size);
PCL6D_FUZZ_TARGETS(PCL6D_FUZZ_DECLARE)
#undef PCL6D_FUZZ_DECLARE

} // namespace pcl6d::fuzz
