// SPDX-License-Identifier: BSD-3-Clause
// Shows: the planes of a scan from a file, largest first.
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/plane_segmentation/segment_planes.h>

#include <iostream>
#include <stdexcept>

int
main(int argc, char** argv)
try {
  if (argc != 2)
    throw std::runtime_error("usage: find_planes SCAN");
  const pcl6d::PlaneCloud cloud(pcl6d::readScan(argv[1]).points);
  for (const pcl6d::PlaneSegment& found : pcl6d::segmentPlanes(cloud).planes)
    std::cout << found.plane.area << " m^2, " << found.points.size()
              << " points, normal " << found.plane.normal.transpose() << '\n';
  return 0;
} catch (const std::exception& e) {
  std::cerr << "find_planes: error: " << e.what() << '\n';
  return 1;
}
