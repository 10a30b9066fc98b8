// SPDX-License-Identifier: BSD-3-Clause
// A plug-in of another interface: nothing behind its number may be read.
#include <pcl6d/slam6d/plugin.h>

extern "C" [[gnu::visibility("default")]] const pcl6d::Plugin pcl6d_plugin;
extern "C" [[gnu::visibility("default")]] const pcl6d::Plugin pcl6d_plugin =
    {pcl6d::kPluginAbi + 998, 1000000, nullptr, nullptr, nullptr, nullptr};
