// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/object_localization/object_symmetry.h>
#include <pcl6d/search/point_tree.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>

namespace pcl6d {
namespace {
constexpr int kMostTurns = 64;

/** \return the mean distance of a surface, turned about z, to itself */
double
errorOfTurn(const Points& points, const PointTree& tree, double angle)
{
  const SinCos turn = portableSinCos(angle);
  double sum = 0;
  for (const auto& p : points) {
    const Eigen::Vector3f turned(
        static_cast<float>(turn.cos * p.x() - turn.sin * p.y()),
        static_cast<float>(turn.sin * p.x() + turn.cos * p.y()),
        p.z());
    sum += std::sqrt(
        tree.nearest(turned, std::numeric_limits<float>::infinity()).distance_sq);
  }
  return sum / static_cast<double>(points.size());
}
} // namespace

ObjectSymmetry
symmetryFromName(const std::string& name)
{
  if (name == "none")
    return {1};
  if (name == "round")
    return {0};
  std::smatch match;
  const bool is_turn = std::regex_match(name, match, std::regex("turn:([1-9][0-9]?)"));
  const int turns = is_turn ? std::stoi(match[1]) : 0;
  require(turns >= 2 && turns <= kMostTurns,
          "symmetry",
          name,
          "none, round, or turn:2 to turn:" + std::to_string(kMostTurns));
  return {turns};
}

std::string
toString(const ObjectSymmetry& symmetry)
{
  if (symmetry.isRound())
    return "round";
  return symmetry.turns == 1 ? "none" : "turn:" + std::to_string(symmetry.turns);
}

double
symmetryError(const OrientedPoints& surface, const ObjectSymmetry& symmetry)
{
  if (surface.size() == 0 || symmetry.turns == 1)
    return 0;
  const PointTree tree(surface.points);
  if (!symmetry.isRound())
    return errorOfTurn(surface.points, tree, 2 * M_PI / symmetry.turns);
  double worst = 0;
  for (const double part : {1.0 / 3, 1.0 / 4, 1.0 / 7}) // of a turn
    worst = std::max(worst, errorOfTurn(surface.points, tree, 2 * M_PI * part));
  return worst;
}

} // namespace pcl6d
