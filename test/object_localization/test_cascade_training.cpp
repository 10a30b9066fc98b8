// SPDX-License-Identifier: BSD-3-Clause
#include "object_localization/cascade_cases.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/object_localization/cascade_evaluator.h>
#include <pcl6d/object_localization/cascade_file.h>
#include <pcl6d/object_localization/cascade_training.h>

#include <gtest/gtest.h>
#include <opencv2/objdetect.hpp>

namespace pcl6d {
namespace {
constexpr int kSize = 16; // [px]

/** Draws the object: a bright frame with a dark middle, a little off its place. */
void
drawObject(GrayImage& image, int x0, int y0, int size, Random& random)
{
  const int bright = test::drawn(random, 160, 230);
  const double off = random.uniform(-0.06, 0.06) * size;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const double u = std::abs(x + off - size / 2.0) / size,
                   v = std::abs(y - off - size / 2.0) / size;
      if (std::max(u, v) < 0.42)
        image.at(y0 + y, x0 + x) = static_cast<std::uint8_t>(
            (std::max(u, v) > 0.2 ? bright : 40) + test::drawn(random, -15, 15));
    }
}

struct Training : testing::Test {
  Training()
  {
    Random random(8);
    for (int i = 0; i < 200; ++i) {
      const GrayImage from = test::randomImage(40, 40, 1000 + i);
      GrayImage window = cropped(
          from, {test::drawn(random, 0, 24), test::drawn(random, 0, 24), kSize, kSize});
      drawObject(window, 0, 0, kSize, random);
      positives.push_back(window);
    }
    for (int i = 0; i < 20; ++i)
      backgrounds.push_back(test::randomImage(90, 120, 2000 + i));
    options.width = options.height = kSize;
    options.features_per_stage = 600;
    options.stages = 4;
    options.negatives = 400;
    options.min_hit_rate = 0.99;
  }
  std::string
  xmlOf(const HaarCascade& cascade) const
  {
    writeCascade(folder / "some.xml", cascade);
    return test::readText(folder / "some.xml");
  }
  void
  expectRefused(const std::string& words) const
  {
    try {
      trainCascade(positives, backgrounds, options);
      ADD_FAILURE() << "accepted, expected " << words;
    } catch (const BadArgument& e) {
      EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
    }
  }
  test::TempFolder folder;
  std::vector<GrayImage> positives;
  std::vector<BackgroundImage> backgrounds;
  CascadeTrainingOptions options;
};
} // namespace

TEST_F(Training, ReachesItsRatesAndFindsNewObjects)
{
  const CascadeTraining training = trainCascade(positives, backgrounds, options);
  ASSERT_EQ(training.stages.size(), 4u);
  EXPECT_EQ(training.end, TrainingEnd::kAllStages);
  double share = 1; // of the backgrounds
  for (const auto& stage : training.stages) {
    EXPECT_GE(stage.hit_rate, options.min_hit_rate);
    EXPECT_LE(stage.false_alarm, options.max_false_alarm);
    EXPECT_LE(stage.background, share);
    EXPECT_EQ(stage.negatives, 400u);
    share = stage.background;
  }
  EXPECT_LT(share, 0.1) << "before the last stage";
  int found = 0;
  std::size_t alarms = 0;
  Random random(77);
  for (int i = 0; i < 40; ++i) {
    GrayImage image = test::randomImage(80, 100, 3000 + i);
    alarms += detectWindows(training.cascade, image).size();
    drawObject(image, 30, 20, 32, random);
    bool hit = false;
    for (const auto& w : detectWindows(training.cascade, image))
      hit = hit || (std::abs(w.x - 30) < 6 && std::abs(w.y - 20) < 6 &&
                    std::abs(w.width - 32) < 8);
    found += hit ? 1 : 0;
  }
  EXPECT_GE(found, 38) << "of 40";
  EXPECT_LT(alarms, 800u) << "of about 50000 windows";
}

TEST_F(Training, GivesTheSameCascadeForAnyNumberOfThreadsAndOpenCvReadsIt)
{
  options.stages = 2;
  options.splits = 2;
  options.num_threads = 1;
  const std::string one = xmlOf(trainCascade(positives, backgrounds, options).cascade);
  EXPECT_FALSE(cv::CascadeClassifier(std::string(folder / "some.xml")).empty());
  options.num_threads = 3;
  EXPECT_EQ(xmlOf(trainCascade(positives, backgrounds, options).cascade), one);
  options.seed = 2;
  EXPECT_NE(xmlOf(trainCascade(positives, backgrounds, options).cascade), one);
}

TEST_F(Training, GoesOnWhereItWasInterrupted)
{
  options.stages = 3;
  const std::string whole =
      xmlOf(trainCascade(positives, backgrounds, options).cascade);
  options.state = folder / "state";
  struct Stop {};
  int seen = 0;
  const auto stop_after_two = [&](const StageReport&) {
    if (++seen == 2)
      throw Stop();
  };
  EXPECT_THROW(trainCascade(positives, backgrounds, options, stop_after_two), Stop);
  const CascadeTraining resumed = trainCascade(positives, backgrounds, options);
  EXPECT_EQ(resumed.resumed_stages, 2u);
  EXPECT_EQ(resumed.stages.size(), 3u);
  EXPECT_EQ(xmlOf(resumed.cascade), whole);
  EXPECT_EQ(trainCascade(positives, backgrounds, options).resumed_stages, 3u);

  const std::string state = test::readText(folder / "state/training.json");
  const std::string schema = "\"schema_version\": 1";
  const std::size_t at = state.find(schema);
  ASSERT_NE(at, std::string::npos) << state;
  std::string older = state, newer = state;
  older.replace(at, schema.size() + 1, "");
  test::writeText(folder / "state/training.json", older);
  EXPECT_EQ(trainCascade(positives, backgrounds, options).resumed_stages, 3u);
  newer.replace(at, schema.size(), "\"schema_version\": 9");
  test::writeText(folder / "state/training.json", newer);
  EXPECT_THROW(trainCascade(positives, backgrounds, options), IoFailed);
  test::writeText(folder / "state/training.json", state);

  options.seed = 9; // another training
  EXPECT_THROW(trainCascade(positives, backgrounds, options), IoFailed);
  options.seed = 1;
  test::writeText(folder / "state/training.json", "{");
  EXPECT_THROW(trainCascade(positives, backgrounds, options), IoFailed);
}

TEST_F(Training, EndsWhenNoNegativesAreLeft)
{
  for (auto& [image, gate] :
       backgrounds) // bright, flat, with one edge: nothing like it
    for (int y = 0; y < image.rows; ++y)
      for (int x = 0; x < image.cols; ++x)
        image.at(y, x) = x < 60 ? 220 : 120;
  const CascadeTraining training = trainCascade(positives, backgrounds, options);
  EXPECT_EQ(training.end, TrainingEnd::kTargetReached);
  EXPECT_LT(training.stages.size(), 4u);
  EXPECT_GE(training.stages.size(), 1u);
}

TEST_F(Training, SaysWhenItCannotSeparate)
{
  for (std::size_t i = 0; i < positives.size(); ++i) // the object is anything
    positives[i] =
        cropped(backgrounds[i % 20].image, {static_cast<int>(i / 4), 7, kSize, kSize});
  options.max_trees = 3;
  options.state = folder / "state";
  const CascadeTraining training = trainCascade(positives, backgrounds, options);
  EXPECT_EQ(training.end, TrainingEnd::kCannotSeparate);
  const CascadeTraining again = trainCascade(positives, backgrounds, options);
  EXPECT_EQ(again.end, TrainingEnd::kCannotSeparate);
  EXPECT_EQ(again.stages.size(), training.stages.size());
}

TEST_F(Training, RefusesWhatItCannotLearnFrom)
{
  options.max_false_alarm = 1;
  expectRefused("max_false_alarm = 1");
  options = {};
  options.width = options.height = kSize;
  const auto kept = positives;
  positives.resize(9);
  expectRefused("positives with contrast = 9");
  positives = kept;
  positives[3] = GrayImage(kSize, kSize + 1);
  expectRefused("positive 3 has 17 x 16 pixels");
  positives.assign(20, GrayImage(kSize, kSize, 50));
  expectRefused("positives with contrast = 0");
  positives = kept;
  backgrounds.assign(3, GrayImage(100, 100, 50));
  expectRefused("backgrounds have 0 windows with contrast");
  backgrounds.clear();
  expectRefused("backgrounds have 0 windows");
}

} // namespace pcl6d
