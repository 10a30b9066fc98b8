// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/fuzz_target.h"
#include "fuzz/targets.h"

#include <algorithm>

namespace pcl6d::fuzz {

const std::vector<Target>&
targets()
{
#define PCL6D_FUZZ_ROW(name, structure, max_size)                                      \
  {#name, name, Structure::structure, max_size},
  static const std::vector<Target> all = {PCL6D_FUZZ_TARGETS(PCL6D_FUZZ_ROW)};
#undef PCL6D_FUZZ_ROW
  return all;
}

const Target*
findTarget(const std::string& name)
{
  const auto& all = targets();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Target& target) {
    return target.name == name;
  });
  return found == all.end() ? nullptr : &*found;
}

} // namespace pcl6d::fuzz
