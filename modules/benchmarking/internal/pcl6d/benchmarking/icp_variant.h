// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/icp_model.h>

#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A variant of ICP: metric, minimiser and search for closest points.
 * \ingroup benchmarking */
struct IcpVariant {
  Metric metric = Metric::kPoint;
  std::string minimiser = "quaternion"; ///< of minimiserNames() for kPoint, else of
                                        ///< planeMinimiserNames()
  SearchMethod search = SearchMethod::kRemembered;
};

bool
operator==(const IcpVariant& a, const IcpVariant& b);

/** \brief The methods to compare; the first of each list is the standard. */
struct IcpMethods {
  std::vector<Metric> metrics = {Metric::kPoint};
  std::vector<std::string> minimisers = {"quaternion"}; ///< of the metric kPoint
  std::vector<std::string> plane_minimisers = {
      "helix"}; ///< of the metrics with normals
  std::vector<SearchMethod> searches = {SearchMethod::kRemembered};
};

/** \brief Combinations of methods to run. */
enum class IcpCombination {
  kOneByOne, ///< every minimiser of every metric with the first search, every search with
             ///< the first metric and minimiser: enough to compare methods of a kind
  kAll       ///< every minimiser of every metric with every search
};

/** \return the variants, for one metric after the other: its first minimiser with every
 * search, then the other minimisers. Duplicates are dropped.
 * \throws BadArgument a list is empty, or a minimiser is unknown
 * \ingroup benchmarking */
std::vector<IcpVariant>
icpVariants(const IcpMethods& methods,
            IcpCombination combination = IcpCombination::kOneByOne);

/** \return options with the variant's metric, minimiser and memory for neighbours
 * \throws BadArgument the minimiser is unknown */
IcpOptions
withVariant(IcpOptions options, const IcpVariant& variant);

} // namespace pcl6d
