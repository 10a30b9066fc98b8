// SPDX-License-Identifier: BSD-3-Clause
#include "options.h"

#include <algorithm>

namespace pcl6d::python {

void
Options::requireKnown() const
{
  for (const auto& [key, value] : values_) {
    const std::string name = py::str(key);
    if (std::find(known_.begin(), known_.end(), name) != known_.end())
      continue;
    std::string all;
    for (const auto& known : known_)
      all += (all.empty() ? "" : ", ") + known;
    throw BadArgument("there is no option " + name + ", but: " + all);
  }
}

} // namespace pcl6d::python
