// SPDX-License-Identifier: BSD-3-Clause
// A plug-in of pcl_slam6d: a minimiser for scanners that stay level, and a reader of
// measurements in polar coordinates.
//   pcl_slam6d SCAN_DIR -o OUT_DIR --plugin build/libslam6d_plugin.so
//     --format polar --metric point --minimiser level
#include <pcl6d/slam6d/plugin.h>

#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace {

/** The best motion without roll and pitch, in closed form: with S = sum w d' m'^T the trace of
 * R S is largest at yaw = atan2(Sxy - Syx, Sxx + Syy). */
pcl6d::RigidEstimate
minimiseLevel(const pcl6d::PairSums& sums)
{
  pcl6d::RigidEstimate estimate;
  const double sine = sums.cross(0, 1) - sums.cross(1, 0);
  const double cosine = sums.cross(0, 0) + sums.cross(1, 1);
  const double length = std::sqrt(sine * sine + cosine * cosine);
  if (sums.count < 2 || !(length > 0)) // no yaw is better than another
    return estimate;
  estimate.status = pcl6d::Status::kOk;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() << cosine, -sine, sine, cosine;
  R.topLeftCorner<2, 2>() /= length;
  estimate.transform.linear() = R;
  estimate.transform.translation() = sums.mean_target - R * sums.mean_source;
  return estimate;
}

/** Rows "azimuth,elevation,range,intensity" in degrees and metres, below one line of titles:
 * azimuth 0 is the x axis (forward), 90 degrees the y axis (left). */
pcl::PCLPointCloud2
readPolar(const std::filesystem::path& file)
{
  std::ifstream stream(file);
  std::string line;
  if (!std::getline(stream, line))
    throw std::runtime_error("cannot be read, or is empty");
  pcl::PointCloud<pcl::PointXYZI> cloud;
  for (int number = 2; std::getline(stream, line); ++number) {
    std::istringstream row(line);
    double azimuth = 0, elevation = 0, range = 0;
    pcl::PointXYZI p;
    char comma = 0;
    if (!(row >> azimuth >> comma >> elevation >> comma >> range >> comma >>
          p.intensity))
      throw std::runtime_error("line " + std::to_string(number) +
                               ": expected azimuth,elevation,range,intensity");
    azimuth *= M_PI / 180;
    elevation *= M_PI / 180;
    p.x = static_cast<float>(range * std::cos(elevation) * std::cos(azimuth));
    p.y = static_cast<float>(range * std::cos(elevation) * std::sin(azimuth));
    p.z = static_cast<float>(range * std::sin(elevation));
    cloud.push_back(p);
  }
  pcl::PCLPointCloud2 read;
  pcl::toPCLPointCloud2(cloud, read);
  return read;
}

void
addParts(pcl6d::PluginRegistry& registry)
{
  registry.addMinimiser("level", minimiseLevel);
  registry.addReader("polar", ".polar", readPolar);
}

} // namespace

PCL6D_PLUGIN("level scanners and polar files", addParts)
