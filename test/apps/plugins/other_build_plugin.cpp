// SPDX-License-Identifier: BSD-3-Clause
// A plug-in as if made with other headers and flags.
#include <pcl6d/slam6d/plugin.h>

#include <array>

namespace {
using Facts = std::array<pcl6d::PluginFact, pcl6d::kNumPluginFacts>;

Facts
otherFacts()
{
  Facts facts{};
  for (std::size_t i = 0; i < facts.size(); ++i)
    facts[i] = pcl6d::kPluginFacts[i];
  facts[1].text = "1.9.1";  // PCL
  facts[2].text = "3.4.77"; // Eigen: another patch of the same version
  facts[4].number = 0;      // _GLIBCXX_USE_CXX11_ABI
  facts[6].number = 64;     // alignment
  return facts;
}

const Facts kFacts = otherFacts();

void
addParts(pcl6d::PluginRegistry& registry)
{
  registry.addMinimiser("other-build", pcl6d::minimiseBySVD);
}
} // namespace

extern "C" [[gnu::visibility("default")]] const pcl6d::Plugin pcl6d_plugin;
extern "C" [[gnu::visibility("default")]] const pcl6d::Plugin pcl6d_plugin = {
    pcl6d::kPluginAbi,
    pcl6d::kNumPluginFacts,
    kFacts.data(),
    "another compiler 1.0",
    "other build",
    addParts};
