// SPDX-License-Identifier: BSD-3-Clause
#include "control/control_start.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/graph_relaxation/control_adjustment.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace pcl6d {

namespace {
/** Points with a smaller spread across their line, in standard deviations, are collinear within
 * noise: the turn about the line is not determined. */
constexpr double kSigmasOfSpread = 10;

std::map<std::string, std::size_t>
placesOf(const std::vector<ControlPoint>& points)
{
  std::map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ControlPoint& point = points[i];
    if (!point.position.allFinite())
      throw BadArgument("control point " + point.name + " is not finite");
    if (point.sigma)
      require(*point.sigma > 0 && std::isfinite(*point.sigma),
              "sigma",
              *point.sigma,
              "finite and > 0 m");
    if (!places.emplace(point.name, i).second)
      throw BadArgument("control point " + point.name + " occurs twice");
  }
  return places;
}

/** \return the names of the targets */
std::set<std::string>
namesOfTargets(const std::vector<ScanTarget>& targets, std::size_t num_scans)
{
  std::set<std::pair<std::string, std::size_t>> known;
  std::set<std::string> names;
  for (const ScanTarget& target : targets) {
    if (!target.position.allFinite())
      throw BadArgument("target " + target.name + " is not finite");
    if (target.scan >= num_scans)
      throw BadArgument("target " + target.name + " is of scan " +
                        std::to_string(target.scan) + ", but there are " +
                        std::to_string(num_scans) + " scans");
    if (!known.emplace(target.name, target.scan).second)
      throw BadArgument("target " + target.name + " occurs twice in scan " +
                        std::to_string(target.scan));
    names.insert(target.name);
  }
  return names;
}

void
requireChecks(const std::vector<std::string>& checks,
              const std::map<std::string, std::size_t>& points,
              const std::set<std::string>& targets)
{
  for (const std::string& name : checks) {
    if (points.count(name) == 0)
      throw BadArgument("check point " + name + " is no control point");
    if (targets.count(name) == 0)
      throw BadArgument("check point " + name + " has no target in any scan");
  }
}
} // namespace

void
ControlOptions::validate(std::size_t num_scans) const
{
  require(std::isfinite(control_sigma) && control_sigma > 0,
          "control_sigma",
          control_sigma,
          "finite and > 0 m");
  require(std::isfinite(target_sigma) && target_sigma > 0,
          "target_sigma",
          target_sigma,
          "finite and > 0 m");
  const auto places = placesOf(points);
  const auto names = namesOfTargets(targets, num_scans);
  if (points.empty() && targets.empty() && checks.empty())
    return;
  requireChecks(checks, places, names);
  std::vector<Eigen::Vector3d> used;
  double sigma = 0;
  for (const ControlPoint& point : points)
    if (names.count(point.name) > 0 &&
        std::find(checks.begin(), checks.end(), point.name) == checks.end()) {
      used.push_back(point.position);
      sigma = std::max(sigma, point.sigma.value_or(control_sigma));
    }
  if (used.size() < 3)
    throw BadArgument("control points: only " + std::to_string(used.size()) + " of " +
                      std::to_string(points.size()) +
                      " have a target in a scan and are no check points, but 3 are "
                      "needed");
  const double spread = graph_relaxation::spreadAcrossLine(used);
  if (spread < kSigmasOfSpread * sigma)
    throw BadArgument("control points: the " + std::to_string(used.size()) +
                      " in use lie on one line (to " + std::to_string(spread) +
                      " m), so the turn about the line is not fixed; add a control "
                      "point beside the line");
}

} // namespace pcl6d
