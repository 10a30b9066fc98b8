// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/icp_model.h>

#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief One way to run ICP: what it minimises, how, and how it finds closest points.
 * \ingroup benchmarking */
struct IcpVariant {
  Metric metric = Metric::kPoint;
  std::string minimiser = "quaternion"; ///< of minimiserNames() for kPoint, else of
                                        ///< planeMinimiserNames()
  SearchMethod search = SearchMethod::kRemembered;
};

bool
operator==(const IcpVariant& a, const IcpVariant& b);

/** \brief The methods that are to be compared; the first of each is the standard one. */
struct IcpMethods {
  std::vector<Metric> metrics = {Metric::kPoint};
  std::vector<std::string> minimisers = {"quaternion"}; ///< of the metric kPoint
  std::vector<std::string> plane_minimisers = {
      "helix"}; ///< of the metrics with normals
  std::vector<SearchMethod> searches = {SearchMethod::kRemembered};
};

/** \brief Which methods are run together. */
enum class IcpCombination {
  kOneByOne, ///< every minimiser of every metric with the first search, every search with
             ///< the first metric and minimiser: enough to compare methods of a kind
  kAll       ///< every minimiser of every metric with every search
};

/** \return the variants, for one metric after the other: its first minimiser with every
 * search, then the other minimisers. What is named twice comes once.
 * \throws BadArgument a list is empty, or there is no minimiser of a name
 * \ingroup benchmarking */
std::vector<IcpVariant>
icpVariants(const IcpMethods& methods,
            IcpCombination combination = IcpCombination::kOneByOne);

/** \return options with the variant's metric, minimiser and memory for neighbours
 * \throws BadArgument there is no such minimiser */
IcpOptions
withVariant(IcpOptions options, const IcpVariant& variant);

} // namespace pcl6d
