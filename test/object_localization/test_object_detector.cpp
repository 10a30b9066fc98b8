// SPDX-License-Identifier: BSD-3-Clause
#include "object_localization/cascade_cases.h"
#include "object_localization/detection_room.h"

#include <pcl6d/common/error.h>
#include <pcl6d/object_localization/cascade_training.h>
#include <pcl6d/object_localization/object_detector.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
namespace {
/** Two small cascades that were trained in the room, made once. */
struct Trained {
  Trained()
  {
    const std::vector<TriangleMesh> models = {test::figure()};
    const WindowShape window = windowShapeOf(models);
    std::vector<BackgroundScan> scans;
    scans.push_back(test::scanFrom(test::room(), 0, 0, 1));
    scans.push_back(test::scanFrom(test::room(), -2.5, -1, 2));
    for (const auto channel : {ImageChannel::kRange, ImageChannel::kReflectance}) {
      TrainingImageOptions options;
      options.positives = 150;
      options.channel = channel;
      const auto images = makeTrainingImages(
          models, window, scannerByName("rotating"), scans, DetectionViews(), options);
      CascadeTrainingOptions training;
      training.width = window.width;
      training.height = window.height;
      training.negatives = 500;
      training.features_per_stage = 1500;
      training.stages = 6;
      cascades.push_back(
          trainCascade(images.positives, images.backgrounds, training).cascade);
      cascades.back().subject = CascadeSubject{channel, window.object_size};
    }
  }
  std::vector<HaarCascade> cascades; // range, reflectance
};

const HaarCascade&
cascadeOf(ImageChannel channel)
{
  static const Trained trained;
  return trained.cascades[channel == ImageChannel::kRange ? 0 : 1];
}

constexpr double kX = 1.5, kY = 1.0; // [m] where the scanner stands

/** \return a scan with the figure ahead of the scanner, turned by an azimuth */
BackgroundScan
scanWithFigure(double azimuth, double distance)
{
  TriangleScene scene = test::room();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << kX + distance * std::cos(azimuth),
      kY + distance * std::sin(azimuth), 0;
  addMesh(scene, test::figure(), pose, {});
  return test::scanFrom(scene, kX, kY, 77);
}

/** \return whether a detection holds the figure, by its points */
bool
isFigure(const DetectedObject& object,
         const Points& points,
         double azimuth,
         double distance)
{
  const Eigen::Vector2f place(static_cast<float>(distance * std::cos(azimuth)),
                              static_cast<float>(distance * std::sin(azimuth)));
  std::size_t on_it = 0;
  for (const auto i : object.points)
    on_it += (points[i].head<2>() - place).norm() < 0.45f ? 1 : 0;
  return on_it > 20 && 2 * on_it > object.points.size();
}
} // namespace

TEST(ObjectDetector, FindsTheFigureAllAroundTheScanner)
{
  const ObjectDetector detector(cascadeOf(ImageChannel::kRange));
  int found = 0, tried = 0;
  for (const double azimuth : {0.1, 1.0, 2.0, 3.1, -2.6, -1.9, -0.6}) {
    const BackgroundScan scan = scanWithFigure(azimuth, 2.0);
    bool hit = false;
    for (const auto& object : detector.detect(scan.points))
      hit = hit || isFigure(object, scan.points, azimuth, 2.0);
    found += hit ? 1 : 0;
    ++tried;
  }
  EXPECT_GE(found, tried - 1);
}

TEST(ObjectDetector, CombinesRangeAndReflectance)
{
  DetectorOptions both, either;
  either.rule = DetectionRule::kOr;
  const HaarCascade &range = cascadeOf(ImageChannel::kRange),
                    &reflectance = cascadeOf(ImageChannel::kReflectance);
  const BackgroundScan scan = scanWithFigure(2.0, 2.0);
  const auto count = [&](const ObjectDetector& detector) {
    return detector.detect(scan.points, scan.reflectance).size();
  };
  const auto of_range = count(ObjectDetector(range));
  const auto of_reflectance = count(ObjectDetector(reflectance));
  const auto of_both = count(ObjectDetector(range, both, reflectance));
  const auto of_either = count(ObjectDetector(range, either, reflectance));
  EXPECT_LE(of_both, std::min(of_range, of_reflectance));
  // Several boxes of the one may be the same object to the other.
  EXPECT_GE(of_either, of_range);
  EXPECT_LE(of_either, of_range + of_reflectance);
  for (const auto& object :
       ObjectDetector(range, both, reflectance).detect(scan.points, scan.reflectance))
    EXPECT_EQ(object.source, DetectionSource::kBoth);
}

// Boxes one before the other in a view are two objects: what a channel sees stays.
TEST(ObjectDetector, CombinesOnlyWhatIsEquallyFar)
{
  constexpr double kSlice = 1; // [m]
  HaarCascade range = test::randomCascade(20, 20, HaarFeatureSet::kAll, 1, 5);
  for (auto& stage : range.stages)
    stage.threshold = -100; // all windows pass that have contrast and can be the object
  HaarCascade reflectance = range;
  range.subject = CascadeSubject{ImageChannel::kRange, 0.8, 0.00873, kSlice};
  reflectance.subject =
      CascadeSubject{ImageChannel::kReflectance, 0.8, 0.00873, kSlice};
  const BackgroundScan scan = scanWithFigure(2.0, 2.0);
  DetectorOptions either;
  either.rule = DetectionRule::kOr;
  const auto seen = [&](const HaarCascade& a, std::optional<HaarCascade> b) {
    return ObjectDetector(a, either, std::move(b))
        .detect(scan.points, scan.reflectance);
  };
  const auto of_either = seen(range, reflectance);
  const auto touch = [](const ImageRect& a, const ImageRect& b) {
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height &&
           b.y < a.y + a.height;
  };
  for (const auto& alone : {seen(range, {}), seen(reflectance, {})}) {
    EXPECT_GT(alone.size(), 20u);
    for (const auto& object : alone)
      EXPECT_TRUE(std::any_of(of_either.begin(),
                              of_either.end(),
                              [&](const DetectedObject& o) {
                                return o.view == object.view &&
                                       touch(o.box, object.box) &&
                                       std::abs(o.range - object.range) <= kSlice / 2;
                              }))
          << "view " << object.view << ", range " << object.range;
  }
}

TEST(ObjectDetector, FindsTheSameWithAnyNumberOfThreads)
{
  const BackgroundScan scan = scanWithFigure(1.0, 2.0);
  DetectorOptions one, three;
  one.views.num_threads = 1;
  three.views.num_threads = 3;
  const auto a =
      ObjectDetector(cascadeOf(ImageChannel::kRange), one).detect(scan.points);
  const auto b =
      ObjectDetector(cascadeOf(ImageChannel::kRange), three).detect(scan.points);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].view, b[i].view);
    EXPECT_EQ(a[i].box, b[i].box);
    EXPECT_EQ(a[i].score, b[i].score);
    EXPECT_EQ(a[i].points, b[i].points);
  }
}

TEST(ObjectDetector, FindsNothingInNothing)
{
  EXPECT_TRUE(ObjectDetector(cascadeOf(ImageChannel::kRange)).detect({}).empty());
}

TEST(ObjectDetector, RefusesCascadesThatItCannotUse)
{
  HaarCascade unknown = test::randomCascade(20, 20, HaarFeatureSet::kAll, 1, 1);
  EXPECT_THROW(ObjectDetector{unknown}, BadArgument);
  unknown.subject = CascadeSubject{ImageChannel::kReflectance, 1};
  EXPECT_THROW(ObjectDetector(unknown, {}, unknown), BadArgument);
  EXPECT_THROW(ObjectDetector(unknown).detect({{1, 2, 3}}), BadArgument);
  DetectorOptions options;
  options.min_neighbours_range = 0;
  EXPECT_THROW(ObjectDetector(unknown, options), BadArgument);
  options = {};
  options.min_neighbours_reflectance = 0;
  EXPECT_THROW(ObjectDetector(unknown, options), BadArgument);
  unknown.stages.clear();
  EXPECT_THROW(ObjectDetector{unknown}, BadArgument);
  EXPECT_EQ(detectionRuleFromName("or"), DetectionRule::kOr);
  EXPECT_THROW(detectionRuleFromName("xor"), BadArgument);
}

} // namespace pcl6d
