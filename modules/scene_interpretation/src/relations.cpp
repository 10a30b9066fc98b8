// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>
#include <pcl6d/common/polygon.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/scene_interpretation/relations.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
namespace {
constexpr Named<Relation> kRelations[] = {{Relation::kParallel, "parallel"},
                                          {Relation::kOrthogonal, "orthogonal"},
                                          {Relation::kAbove, "above"},
                                          {Relation::kUnder, "under"},
                                          {Relation::kEqualHeight, "equalheight"},
                                          {Relation::kOnto, "onto"},
                                          {Relation::kRecessed, "recessed"},
                                          {Relation::kHinged, "hinged"},
                                          {Relation::kStep, "step"},
                                          {Relation::kTouches, "touches"},
                                          {Relation::kApart, "apart"}};

bool
areParallel(const ScenePlane& i, const ScenePlane& j, double tau)
{
  return std::abs(i.normal.dot(j.normal)) > portableSinCos(tau).cos;
}

bool
areOrthogonal(const ScenePlane& i, const ScenePlane& j, double tau)
{
  return std::abs(i.normal.dot(j.normal)) < portableSinCos(tau).sin;
}

// Height of i's centre over the carrier plane of j, on the side of j's normal.
double
inFront(const ScenePlane& i, const ScenePlane& j)
{
  return j.normal.dot(i.centre - j.centre);
}

bool
isOnto(const ScenePlane& i, const ScenePlane& j, const RelationTolerances& t)
{
  return areParallel(i, j, t.angle) && std::abs(inFront(i, j)) < t.height;
}

bool
isRecessed(const ScenePlane& i, const ScenePlane& j, const RelationTolerances& t)
{
  if (i.side_known && j.side_known && i.normal.dot(j.normal) < 0)
    return false; // no door of the front is on the back of a wall
  return isOnto(i, j, t) && isInside(j.corners, j.normal, i.centre, t.touch) &&
         (!j.side_known || inFront(i, j) < t.in_front);
}

// Whether the leaf i turns about one of its upright edges, near the wall j.
bool
isHinged(const ScenePlane& i, const ScenePlane& j, const RelationTolerances& t)
{
  const double sine = portableSinCos(t.angle).sin;
  if (std::abs(i.normal.z()) > sine || std::abs(j.normal.z()) > sine ||
      std::abs(i.normal.dot(j.normal)) > portableSinCos(t.hinge_angle).cos)
    return false;
  const Eigen::Vector3d along =
      Eigen::Vector3d(-i.normal.y(), i.normal.x(), 0).normalized();
  for (const double sign : {-0.5, 0.5}) {
    const Eigen::Vector3d edge = i.centre + sign * i.width * along;
    if (std::abs(j.normal.dot(edge - j.centre)) < t.hinge &&
        isInside(j.corners, j.normal, edge, t.hinge))
      return true;
  }
  return false;
}

bool
isStep(const ScenePlane& i, const ScenePlane& j, const RelationTolerances& t)
{
  const double rise = std::abs(i.centre.z() - j.centre.z());
  return rise > t.min_step && rise < t.max_step && overlapInPlan(i, j, t.touch);
}
} // namespace

const char*
toString(Relation relation)
{
  return nameOf(kRelations, relation);
}

std::optional<Relation>
relationFromName(const std::string& name)
{
  return findNamed(kRelations, name);
}

std::string
relationNames()
{
  return listed(kRelations, WordList::kCommas);
}

void
RelationTolerances::validate() const
{
  constexpr double kEighth = 0.7853981633974483; // [rad] 45 deg
  require(angle > 0 && angle < kEighth, "angle", angle, "in (0, pi/4) [rad]");
  require(height > 0, "height", height, "> 0 [m]");
  require(touch > 0, "touch", touch, "> 0 [m]");
  require(in_front >= 0, "in_front", in_front, ">= 0 [m]");
  require(hinge > 0, "hinge", hinge, "> 0 [m]");
  require(hinge_angle > 0 && hinge_angle < 2 * kEighth,
          "hinge_angle",
          hinge_angle,
          "in (0, pi/2) [rad]");
  require(min_step > 0, "min_step", min_step, "> 0 [m]");
  require(max_step > min_step, "max_step", max_step, "> min_step [m]");
}

bool
holds(Relation relation,
      const ScenePlane& i,
      const ScenePlane& j,
      const RelationTolerances& t)
{
  switch (relation) {
  case Relation::kParallel:
    return areParallel(i, j, t.angle);
  case Relation::kOrthogonal:
    return areOrthogonal(i, j, t.angle);
  case Relation::kAbove:
    return i.centre.z() > j.centre.z() + t.height;
  case Relation::kUnder:
    return j.centre.z() > i.centre.z() + t.height;
  case Relation::kEqualHeight:
    return std::abs(i.centre.z() - j.centre.z()) < t.height;
  case Relation::kOnto:
    return isOnto(i, j, t);
  case Relation::kRecessed:
    return isRecessed(i, j, t);
  case Relation::kHinged:
    return isHinged(i, j, t);
  case Relation::kStep:
    return isStep(i, j, t);
  case Relation::kTouches:
    return hullDistance(i, j) < t.touch;
  case Relation::kApart:
    return !overlapInPlan(i, j);
  }
  return false;
}

std::string
toString(const RelationRule& rule)
{
  if (rule.kind == RelationRule::Kind::kRelation)
    return toString(rule.relation);
  if (rule.kind == RelationRule::Kind::kNot)
    return "not " + toString(rule.parts.front());
  const std::string joint = rule.kind == RelationRule::Kind::kAll ? " and " : " or ";
  std::string text;
  for (const auto& part : rule.parts) {
    const bool is_list =
        part.kind == RelationRule::Kind::kAll || part.kind == RelationRule::Kind::kAny;
    const std::string inner = toString(part);
    text += (text.empty() ? "" : joint) + (is_list ? "(" + inner + ")" : inner);
  }
  return text;
}

bool
holds(const RelationRule& rule,
      const ScenePlane& i,
      const ScenePlane& j,
      const RelationTolerances& tolerances)
{
  const auto is_kept = [&](const RelationRule& part) {
    return holds(part, i, j, tolerances);
  };
  switch (rule.kind) {
  case RelationRule::Kind::kRelation:
    return holds(rule.relation, i, j, tolerances);
  case RelationRule::Kind::kAll:
    return std::all_of(rule.parts.begin(), rule.parts.end(), is_kept);
  case RelationRule::Kind::kAny:
    return std::any_of(rule.parts.begin(), rule.parts.end(), is_kept);
  case RelationRule::Kind::kNot:
    return !is_kept(rule.parts.front());
  }
  return false;
}

} // namespace pcl6d
