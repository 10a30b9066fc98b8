// SPDX-License-Identifier: BSD-3-Clause
#include "object_localization/detection_room.h"
#include "support/folders.h"

#include <pcl6d/object_localization/cascade_file.h>
#include <pcl6d/object_localization/model_store.h>
#include <pcl6d/object_localization/object_detector.h>

#include <gtest/gtest.h>
#include <opencv2/objdetect.hpp>

namespace pcl6d {
namespace {
const std::filesystem::path kShipped = PCL6D_SOURCE_DIR "/share/models";

/** \return a scan with the model on the floor, 2.2 m from the scanner */
BackgroundScan
scanWith(const StoredModel& stored, double azimuth)
{
  TriangleScene scene = test::room();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << 2.2 * std::cos(azimuth), 2.2 * std::sin(azimuth), 0;
  pose.linear() =
      Eigen::AngleAxisd(1 + azimuth, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  addMesh(scene, stored.mesh, pose, {});
  return test::scanFrom(scene, 0, 0, 7);
}

bool
finds(const ObjectDetector& detector, const BackgroundScan& scan, double azimuth)
{
  const Eigen::Vector3d place(2.2 * std::cos(azimuth), 2.2 * std::sin(azimuth), -0.4);
  for (const auto& object : detector.detect(scan.points, scan.reflectance)) {
    const auto p = detector.views().place(object.view, place);
    if (p.depth > 0 && std::abs(object.range - place.norm()) < 0.7 &&
        p.x > object.box.x && p.x < object.box.x + object.box.width &&
        p.y > object.box.y && p.y < object.box.y + object.box.height)
      return true;
  }
  return false;
}

class ShippedCascade : public testing::TestWithParam<const char*> {};
} // namespace

TEST_P(ShippedCascade, IsSmallAndReadByOpenCv)
{
  const StoredModel stored = readStoredModel(kShipped / GetParam());
  ASSERT_TRUE(stored.range_cascade && stored.reflectance_cascade);
  for (const auto& file : {*stored.range_cascade, *stored.reflectance_cascade}) {
    EXPECT_LT(std::filesystem::file_size(file), 300000u) << file;
    EXPECT_FALSE(cv::CascadeClassifier(file.string()).empty()) << file;
  }
  EXPECT_EQ(readCascade(*stored.range_cascade).subject->channel, ImageChannel::kRange);
  EXPECT_EQ(readCascade(*stored.reflectance_cascade).subject->channel,
            ImageChannel::kReflectance);
}

// A room, and a floor below the scanner, that it was not trained on.
TEST_P(ShippedCascade, FindsItsModelAllAroundTheScanner)
{
  const StoredModel stored = readStoredModel(kShipped / GetParam());
  DetectorOptions either;
  either.rule = DetectionRule::kOr;
  const ObjectDetector detector(readCascade(*stored.range_cascade),
                                either,
                                readCascade(*stored.reflectance_cascade));
  int found = 0;
  for (const double azimuth : {0.2, 1.2, 2.2, -2.9, -1.9, -0.9})
    found += finds(detector, scanWith(stored, azimuth), azimuth) ? 1 : 0;
  EXPECT_GE(found, 5) << "of 6";
}

INSTANTIATE_TEST_SUITE_P(Models,
                         ShippedCascade,
                         testing::Values("bin", "box", "chair", "person", "table"),
                         [](const auto& model) { return std::string(model.param); });

} // namespace pcl6d
