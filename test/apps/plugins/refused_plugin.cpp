// SPDX-License-Identifier: BSD-3-Clause
// Plug-ins that cannot be taken in: what they do is chosen by PCL6D_TEST_FAULT.
#include <pcl6d/slam6d/plugin.h>

#include <stdexcept>

namespace {
void
addParts(pcl6d::PluginRegistry& registry)
{
  registry.addMinimiser("before-the-fault", pcl6d::minimiseBySVD);
#if PCL6D_TEST_FAULT == 1
  registry.addMinimiser("helix", pcl6d::minimiseBySVD); // the suite has it
#elif PCL6D_TEST_FAULT == 2
  registry.addMinimiser("test-svd", pcl6d::minimiseBySVD); // good_plugin has it
#elif PCL6D_TEST_FAULT == 3
  registry.addFilter("Two Words", [](const auto& cloud) { return cloud; });
#elif PCL6D_TEST_FAULT == 4
  throw std::runtime_error("not today");
#elif PCL6D_TEST_FAULT == 5
  throw 5;
#elif PCL6D_TEST_FAULT == 6
  registry.addSearch("none", nullptr);
#elif PCL6D_TEST_FAULT == 7
  registry.addReader(
      "dotless", "xyz", [](const auto&) { return pcl::PCLPointCloud2(); });
#endif
}

#if PCL6D_TEST_FAULT == 8
struct Bomb {
  Bomb() { throw std::runtime_error("boom"); }
} const kBomb;
#endif
} // namespace

PCL6D_PLUGIN("faults", addParts)
