// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/benchmarking/icp_variant.h>
#include <pcl6d/common/require.h>
#include <pcl6d/registration/minimisers.h>

#include <algorithm>

namespace pcl6d {

bool
operator==(const IcpVariant& a, const IcpVariant& b)
{
  return a.metric == b.metric && a.minimiser == b.minimiser && a.search == b.search;
}

std::vector<IcpVariant>
icpVariants(const IcpMethods& methods, IcpCombination combination)
{
  require(!methods.metrics.empty(), "metrics", "none", "one at least");
  require(!methods.searches.empty(), "searches", "none", "one at least");
  std::vector<IcpVariant> variants;
  for (const Metric metric : methods.metrics) {
    const auto& minimisers =
        metric == Metric::kPoint ? methods.minimisers : methods.plane_minimisers;
    require(!minimisers.empty(), "minimisers", "none", "one at least");
    for (const std::string& minimiser : minimisers)
      for (const SearchMethod search : methods.searches) {
        const IcpVariant variant{metric, minimiser, search};
        withVariant({}, variant); // throws if the minimiser is unknown
        const bool is_first =
            metric == methods.metrics.front() && minimiser == minimisers.front();
        if ((combination == IcpCombination::kAll || is_first ||
             search == methods.searches.front()) &&
            std::find(variants.begin(), variants.end(), variant) == variants.end())
          variants.push_back(variant);
      }
  }
  return variants;
}

IcpOptions
withVariant(IcpOptions options, const IcpVariant& variant)
{
  options.metric = variant.metric;
  if (variant.metric == Metric::kPoint)
    options.minimiser = minimiserFromName(variant.minimiser);
  else
    options.plane_minimiser = planeMinimiserFromName(variant.minimiser);
  options.remember_neighbours = variant.search == SearchMethod::kRemembered;
  return options;
}

} // namespace pcl6d
