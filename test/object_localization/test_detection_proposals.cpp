// SPDX-License-Identifier: BSD-3-Clause
#include "object_localization/detection_room.h"
#include "object_localization/localization_cases.h"

#include <pcl6d/common/error.h>
#include <pcl6d/object_localization/detection_proposals.h>
#include <pcl6d/plane_segmentation/segment_planes.h>

#include <gtest/gtest.h>

#include <cmath>

namespace pcl6d {
namespace {
constexpr double kFloor = -0.8; // [m] in the scan's frame
constexpr double kDepth = 1;    // [m]

/** A room with a block of 0.4 m x 0.6 m x 0.5 m, 1.6 m ahead of the scanner. */
class DetectionProposals : public testing::Test {
protected:
  DetectionProposals() : cloud_(scan()), planes_(segmentPlanes(cloud_)) {}

  static Points
  scan()
  {
    TriangleScene scene = test::room();
    addBox(scene, {1.6, -0.3, 0}, {2.0, 0.3, 0.5}, {});
    return test::scanOf(
        scene, scannerByName("rotating"), poseFromEuler({0, 0, 0.8}, {}));
  }

  /** What a detector would give: all points within a cone about the x axis. */
  DetectedObject
  ahead(double half_angle, double lowest = -INFINITY) const
  {
    DetectedObject detection;
    for (std::size_t i = 0; i < cloud_.points().size(); ++i) {
      const Eigen::Vector3f& p = cloud_.points()[i];
      if (std::abs(std::atan2(p.y(), p.x())) < half_angle && p.z() > lowest)
        detection.points.push_back(i);
    }
    return detection;
  }

  bool
  isOnBlock(const Eigen::Vector3f& p) const
  {
    return p.x() > 1.59F && p.x() < 2.01F && std::abs(p.y()) < 0.31F &&
           p.z() > kFloor + 0.005 && p.z() < kFloor + 0.51;
  }

  PlaneCloud cloud_;
  PlaneSegments planes_;
};
} // namespace

TEST_F(DetectionProposals, HoldThePointsOfTheObjectAlone)
{
  const DetectedObject detection = ahead(0.25);
  ASSERT_GT(detection.points.size(), 1000u);
  const auto proposals = proposeDetections(cloud_, planes_, {detection}, kDepth);
  ASSERT_EQ(proposals.size(), 1u);
  const ObjectProposal& block = proposals[0];
  std::size_t on_it = 0;
  for (const auto place : block.points)
    on_it += isOnBlock(cloud_.points()[place]) ? 1 : 0;
  std::size_t all = 0;
  for (const auto& p : cloud_.points())
    all += isOnBlock(p) ? 1 : 0;
  EXPECT_GT(on_it, 0.95 * static_cast<double>(block.points.size()));
  EXPECT_GT(on_it, 0.9 * static_cast<double>(all));
  // It stands upright on the floor.
  EXPECT_NEAR(block.T_scene_box.translation().z(), kFloor, 0.01);
  EXPECT_LT((block.T_scene_box.linear().col(2) - Eigen::Vector3d::UnitZ()).norm(),
            0.01);
  EXPECT_NEAR(block.size.z(), 0.5, 0.03);
  EXPECT_NEAR(block.size.x(), 0.6, 0.05);
}

TEST_F(DetectionProposals, AreNotMadeOfBackgroundOrOfFewPoints)
{
  DetectedObject floor, few;
  for (std::size_t i = 0; i < cloud_.points().size(); ++i)
    if (cloud_.points()[i].norm() < 1.4F) // nothing else is so near
      floor.points.push_back(i);
  few.points = ahead(0.1, -0.7).points;
  few.points.resize(9);
  EXPECT_TRUE(proposeDetections(cloud_, planes_, {floor, few, DetectedObject()}, kDepth)
                  .empty());
  EXPECT_TRUE(proposeDetections(cloud_, planes_, {}, kDepth).empty());
}

TEST_F(DetectionProposals, NeedAPlaneBelow)
{
  const DetectedObject detection = ahead(0.25);
  EXPECT_TRUE(proposeDetections(cloud_, PlaneSegments(), {detection}, kDepth).empty());
}

TEST_F(DetectionProposals, RefuseADepthThatIsNone)
{
  for (const double depth : {0.0, -1.0, double{INFINITY}, double{NAN}})
    EXPECT_THROW(proposeDetections(cloud_, planes_, {}, depth), BadArgument);
}

} // namespace pcl6d
