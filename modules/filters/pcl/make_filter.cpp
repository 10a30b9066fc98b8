// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>
#include <pcl6d/filters/line_filter.h>
#include <pcl6d/filters/pcl/make_filter.h>

#include <algorithm>

namespace pcl6d {

namespace filters {

FilterKind
filterKindFromName(const std::string& name)
{
  const std::vector<std::string> names = filterNames();
  std::string rule;
  for (const std::string& one : names)
    rule += (rule.empty() ? "" : "|") + one;
  require(
      std::find(names.begin(), names.end(), name) != names.end(), "filter", name, rule);
  return name == toString(LineFilter::kMedian)      ? FilterKind::kMedian
         : name == toString(LineFilter::kReduction) ? FilterKind::kLineReduction
                                                    : FilterKind::kReduction;
}

} // namespace filters

std::vector<std::string>
filterNames()
{
  std::vector<std::string> names = reductionMethodNames();
  names.push_back(toString(LineFilter::kMedian));
  names.push_back(toString(LineFilter::kReduction));
  return names;
}

#define PCL6D_MAKE_NOTHING_
PCL6D_FOR_POINT_TYPES(PCL6D_MAKE_FILTER_, PCL6D_MAKE_NOTHING_)

} // namespace pcl6d
