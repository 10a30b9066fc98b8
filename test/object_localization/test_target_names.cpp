// SPDX-License-Identifier: BSD-3-Clause
#include "support/points.h"

#include <pcl6d/common/random.h>
#include <pcl6d/object_localization/target_names.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

using Eigen::Vector3d;
using pcl6d::ControlPoint;
using pcl6d::FoundTarget;
using pcl6d::namesByDistances;
using Names = std::vector<std::string>;

namespace {
const Eigen::Isometry3d kPose =
    Eigen::Translation3d(500000, 4000000, 100) *
    Eigen::AngleAxisd(1, Vector3d(0.1, 0.2, 1).normalized());

std::vector<ControlPoint>
controlNet()
{
  const Vector3d places[] = {
      {0, 0, 0}, {5, 1, 0.5}, {2, 4, 1}, {-3, 2, 0.2}, {1, -4, 2}, {7, 7, 0}};
  std::vector<ControlPoint> control;
  for (std::size_t k = 0; k < 6; ++k)
    control.push_back({"C" + std::to_string(k), kPose * places[k], {}});
  return control;
}

/** \return targets of control points in the scan's frame, 1 mm off */
std::vector<FoundTarget>
targetsOf(const std::vector<ControlPoint>& control, const std::vector<std::size_t>& of)
{
  pcl6d::Random random(3);
  std::vector<FoundTarget> targets;
  for (const std::size_t k : of) {
    FoundTarget target;
    target.centre = kPose.inverse() * control[k].position +
                    Vector3d::NullaryExpr([&] { return 0.001 * random.normal(); });
    target.sigma = 0.001;
    targets.push_back(target);
  }
  return targets;
}
} // namespace

TEST(TargetNames, AreThoseOfTheControlPointsWithTheirDistances)
{
  const auto control = controlNet();
  EXPECT_EQ(namesByDistances(targetsOf(control, {3, 0, 5, 1}), control).names,
            (Names{"C3", "C0", "C5", "C1"}));
  EXPECT_EQ(namesByDistances(targetsOf(control, {4, 2, 1}), control).names,
            (Names{"C4", "C2", "C1"}));
}

TEST(TargetNames, AreNotGivenToWhatIsNoControlPoint)
{
  const auto control = controlNet();
  auto targets = targetsOf(control, {3, 0, 5, 1});
  targets[2].centre += Vector3d(0.3, 0, 0.1);
  const auto named = namesByDistances(targets, control);
  EXPECT_EQ(named.names, (Names{"C3", "C0", "", "C1"}));
  EXPECT_EQ(named.doubt, "");
}

TEST(TargetNames, AreNotGivenWhereTwoWaysFit)
{
  // Four corners of a rectangle: half a turn changes no distance.
  std::vector<ControlPoint> control;
  for (int k = 0; k < 4; ++k)
    control.push_back(
        {"C" + std::to_string(k), kPose * Vector3d(k % 2 * 3, k / 2 * 2, 0), {}});
  const auto named = namesByDistances(targetsOf(control, {0, 1, 2, 3}), control);
  EXPECT_EQ(named.names, Names(4));
  EXPECT_EQ(named.doubt.find("ambiguous: a target may be C"), 0U) << named.doubt;
}

TEST(TargetNames, AreNotThoseOfAMirrorImage)
{
  const auto control = controlNet();
  auto targets = targetsOf(control, {0, 1, 2, 4});
  for (auto& target : targets)
    target.centre.z() *= -1;
  const auto named = namesByDistances(targets, control);
  for (const auto& name : named.names)
    EXPECT_LE(std::count(named.names.begin(), named.names.end(), name), 4);
  EXPECT_NE(named.names, (Names{"C0", "C1", "C2", "C4"}));
}

TEST(TargetNames, NeedThreeTargetsThatAreNotOnALine)
{
  const auto control = controlNet();
  EXPECT_EQ(namesByDistances(targetsOf(control, {0, 1}), control).doubt,
            "fewer than three targets");
  std::vector<ControlPoint> line;
  for (int k = 0; k < 3; ++k)
    line.push_back({"C" + std::to_string(k), kPose * Vector3d(k * k + 1, 0, 0), {}});
  EXPECT_EQ(namesByDistances(targetsOf(line, {0, 1, 2}), line).doubt,
            "no three targets have the distances of control points");
  EXPECT_EQ(namesByDistances(targetsOf(control, {0, 1, 2}), {}).doubt,
            "no three targets have the distances of control points");
}
