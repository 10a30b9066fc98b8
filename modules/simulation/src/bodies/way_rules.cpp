// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/simulation/way_rules.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
namespace {
constexpr double kShoulders = 0.25; // [m] radius of a person, see personModel()
} // namespace

const char*
toString(BodyKind kind)
{
  return kind == BodyKind::kPerson ? "person" : "car";
}

WayRules
wayRules(BodyKind kind)
{
  // Four discs cover a rectangle of 4.3 m x 1.76 m.
  return kind == BodyKind::kPerson
             ? WayRules{1.1, 1.7, kShoulders + 0.05, {0}, 1.2, 2, 10, 1.5, 15}
             : WayRules{3, 8, 1.05, {-1.65, -0.55, 0.55, 1.65}, 3.5, 4, 25, 5, 50};
}

void
ScannerTrack::validate() const
{
  require(!times.empty(), "number of times", times.size(), ">= 1");
  require(places.size() == times.size(),
          "number of places",
          places.size(),
          "that of the times");
  for (std::size_t i = 0; i < times.size(); ++i)
    require(std::isfinite(times[i]) && (i == 0 || times[i] > times[i - 1]),
            "time",
            times[i],
            "finite and after the previous time");
  require(times.back() - times.front() <= kLongestTrack,
          "time from the first place to the last [s]",
          times.back() - times.front(),
          "at most 1e5: ways are laid for the whole duration");
}

Eigen::Vector3d
ScannerTrack::placeAt(double time) const
{
  const auto next = std::upper_bound(times.begin(), times.end(), time);
  if (next == times.begin())
    return places.front();
  if (next == times.end())
    return places.back();
  const auto i = static_cast<std::size_t>(next - times.begin());
  const double part = (time - times[i - 1]) / (times[i] - times[i - 1]);
  return places[i - 1] + part * (places[i] - places[i - 1]);
}

} // namespace pcl6d
