// SPDX-License-Identifier: BSD-3-Clause
// A plug-in that is loaded without complaint, and whose parts break their promises.
#include <pcl6d/slam6d/plugin.h>

#include <limits>
#include <stdexcept>

namespace {
using pcl6d::Neighbour;

pcl6d::RigidEstimate
estimateOf(double scale)
{
  pcl6d::RigidEstimate estimate;
  estimate.status = pcl6d::Status::kOk;
  estimate.transform.linear() *= scale;
  return estimate;
}

pcl6d::NearestSearch
searchThatFinds(int index)
{
  return [index](const Eigen::Vector3f&, float) { return Neighbour{index, 0}; };
}

/** A cloud that says that it has more points than it has. */
pcl::PCLPointCloud2
makeHollowCloud()
{
  pcl::PCLPointCloud2 cloud;
  cloud.width = 1000;
  cloud.height = 1;
  cloud.point_step = 12;
  for (const char* const name : {"x", "y", "z"}) {
    pcl::PCLPointField field;
    field.name = name;
    field.offset = static_cast<pcl::uindex_t>(4 * cloud.fields.size());
    field.datatype = pcl::PCLPointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
  }
  return cloud;
}

void
addParts(pcl6d::PluginRegistry& registry)
{
  registry.addMinimiser("throws", [](const auto&) -> pcl6d::RigidEstimate {
    throw std::runtime_error("no motion today");
  });
  registry.addMinimiser("throws-a-number",
                        [](const auto&) -> pcl6d::RigidEstimate { throw 7; });
  registry.addMinimiser("scales", [](const auto&) { return estimateOf(2); });
  registry.addPlaneMinimiser("nan", [](const auto&) {
    return estimateOf(std::numeric_limits<double>::quiet_NaN());
  });
  registry.addSearch("beyond", [](const auto& points) {
    return searchThatFinds(static_cast<int>(points.size()));
  });
  registry.addSearch("empty", [](const auto&) { return pcl6d::NearestSearch(); });
  registry.addSearch("throws", [](const auto&) -> pcl6d::NearestSearch {
    throw std::runtime_error("no tree today");
  });
  registry.addFilter("hollow", [](const auto&) { return makeHollowCloud(); });
  registry.addFilter("fieldless", [](const auto&) { return pcl::PCLPointCloud2(); });
  registry.addFilter("throws", [](const auto&) -> pcl::PCLPointCloud2 {
    throw std::runtime_error("no points today");
  });
  registry.addReader("hollow", ".xyz", [](const auto&) { return makeHollowCloud(); });
  registry.addReader("throws", ".xyz", [](const auto&) -> pcl::PCLPointCloud2 {
    throw std::runtime_error("no file today");
  });
}
} // namespace

PCL6D_PLUGIN("parts that break their promises", addParts)
