// SPDX-License-Identifier: BSD-3-Clause
// Shows: the pose of one scan relative to another, from two files and without an initial pose.
#include <pcl6d/global_registration/pcl/global_registration.h>
#include <pcl6d/io/scan_reader.h>

#include <pcl/conversions.h>

#include <iostream>
#include <stdexcept>

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

Cloud::Ptr
readCloud(const char* file)
{
  Cloud::Ptr cloud(new Cloud);
  pcl::fromPCLPointCloud2(pcl6d::readScan(file).cloud, *cloud);
  return cloud;
}

int
main(int argc, char** argv)
try {
  if (argc != 3)
    throw std::runtime_error("usage: register_two_scans TARGET SOURCE");
  pcl6d::GlobalRegistration<pcl::PointXYZ, pcl::PointXYZ> registration;
  registration.setInputTarget(readCloud(argv[1]));
  registration.setInputSource(readCloud(argv[2]));
  Cloud aligned; // the points of SOURCE in the frame of TARGET
  registration.align(aligned);
  std::cout << toString(registration.answer()) << '\n'
            << registration.getFinalTransformation() << '\n';
  return registration.hasConverged() ? 0 : 3; // converged: one pose fits, and no other
} catch (const std::exception& e) {
  std::cerr << "register_two_scans: error: " << e.what() << '\n';
  return 1;
}
