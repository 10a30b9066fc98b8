// SPDX-License-Identifier: BSD-3-Clause
#include "pose/object_candidates.h"

#include <pcl6d/common/require.h>
#include <pcl6d/object_localization/localized_object.h>

#include <algorithm>
#include <iterator>

namespace pcl6d {
using namespace object_localization;

double
object_localization::scoreOf(const PoseCheck& check)
{
  return check.visibleFraction() * (1 - check.freeSpaceViolation());
}

double
object_localization::trust(const PoseCheck& check)
{
  const std::size_t measured = check.facing() - check.unseen;
  const double seen = measured == 0 ? 0
                                    : static_cast<double>(check.supported) /
                                          static_cast<double>(measured);
  return seen * check.agreement() * (1 - check.freeSpaceViolation());
}

double
object_localization::explanation(const PoseCheck& check)
{
  return static_cast<double>(check.support.size()) * trust(check);
}

namespace {
using Places = std::vector<std::uint32_t>;

/** \return share of the smaller set that is also in the other set */
double
sharedShare(const Places& a, const Places& b)
{
  Places both;
  std::set_intersection(
      a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both.empty() ? 0
                      : static_cast<double>(both.size()) /
                            static_cast<double>(std::min(a.size(), b.size()));
}

/** Drops elements that share indices with a better one; best first.
 * \param[in] value of an element, larger is better \param[in] placesOf indices of an
 * element */
template <typename T, typename Value, typename PlacesOf>
std::vector<T>
withoutShared(std::vector<T> all, double max_shared, Value value, PlacesOf placesOf)
{
  std::stable_sort(all.begin(), all.end(), [&](const T& a, const T& b) {
    return value(a) > value(b);
  });
  std::vector<T> kept;
  for (auto& one : all) {
    const auto isSame = [&](const T& other) {
      return sharedShare(placesOf(one), placesOf(other)) > max_shared;
    };
    if (std::none_of(kept.begin(), kept.end(), isSame))
      kept.push_back(std::move(one));
  }
  return kept;
}
} // namespace

std::vector<ObjectCandidate>
object_localization::strongest(std::vector<ObjectCandidate> candidates,
                               double max_shared)
{
  return withoutShared(
      std::move(candidates),
      max_shared,
      [](const auto& c) { return explanation(c.check); },
      [](const auto& c) -> const Places& { return c.check.support; });
}

std::vector<LocalizedObject>
strongestObjects(std::vector<LocalizedObject> objects, double max_shared)
{
  require(max_shared >= 0 && max_shared <= 1, "max_shared", max_shared, "0 to 1");
  return withoutShared(
      std::move(objects),
      max_shared,
      [](const auto& o) { return o.evidence; },
      [](const auto& o) -> const Places& { return o.points; });
}

} // namespace pcl6d
