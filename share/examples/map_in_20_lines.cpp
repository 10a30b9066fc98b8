// SPDX-License-Identifier: BSD-3-Clause
// Shows: from a folder of scans to a registered map, the whole chain in 20 lines.
#include <pcl6d/common/pose.h>
#include <pcl6d/filters/map_builder.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/slam6d/slam6d.h>

#include <iostream>
#include <stdexcept>

int
main(int argc, char** argv)
try {
  if (argc != 3)
    throw std::runtime_error("usage: map_in_20_lines SCAN_DIR MAP.pcd");
  const pcl6d::ScanFolder folder(argv[1]);
  pcl6d::Slam6D slam;
  for (std::size_t i = 0; i < folder.size(); ++i)
    slam.addScan(folder.read(i).points, folder.initialPose(i), folder.file(i).string());
  slam.optimize();

  const pcl6d::Slam6DResult& result = slam.result();
  pcl6d::MapBuilder map(result.parameters.voxel.value,
                        pcl6d::worldOffset(result.scans[0].T_world_scan));
  for (std::size_t i = 0; i < folder.size(); ++i)
    map.addScan(folder.read(i).points, {}, result.scans[i].T_world_scan, i);
  pcl6d::writePcd(argv[2], map.cloud());
  std::cout << result.count(pcl6d::ScanState::kMatched) << " of " << folder.size() - 1
            << " scans matched to the first, " << map.points().size() << " points in "
            << argv[2] << '\n';
  return result.trusted() ? 0 : 3;
} catch (const std::exception& e) {
  std::cerr << "map_in_20_lines: error: " << e.what() << '\n';
  return 1;
}
