// SPDX-License-Identifier: BSD-3-Clause
#include "cascade/training_state.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/random.h>
#include <pcl6d/io/json_numbers.h>
#include <pcl6d/io/json_object.h>
#include <pcl6d/io/text.h>
#include <pcl6d/object_localization/cascade_file.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace pcl6d::object_localization {
namespace {
using Json = nlohmann::ordered_json;

constexpr int kTrainingSchema = 1; ///< schema_version of training.json

/** Hash of every input that determines the result. */
class Fingerprint {
public:
  void
  add(std::uint64_t value)
  {
    hash_ = mixBits(hash_ ^ value);
  }
  void
  add(double value)
  {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    add(bits);
  }
  void
  add(const GrayImage& image)
  {
    add(static_cast<std::uint64_t>(image.rows));
    for (const std::uint8_t gray : image.pixels)
      hash_ = (hash_ ^ gray) * 0x100000001b3ull; // FNV-1a
  }
  std::string
  text() const
  {
    char digits[17];
    std::snprintf(
        digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash_));
    return digits;
  }

private:
  std::uint64_t hash_ = 0xcbf29ce484222325ull;
};

// Not of the number of stages and threads: a training may be continued with more.
Fingerprint
of(const CascadeTrainingOptions& o)
{
  Fingerprint print;
  for (const int number : {o.width, o.height, o.splits, o.max_trees})
    print.add(static_cast<std::uint64_t>(number));
  for (const double number : {o.min_hit_rate, o.max_false_alarm, o.scale_factor})
    print.add(number);
  print.add(static_cast<std::uint64_t>(o.features == HaarFeatureSet::kAll));
  print.add(std::uint64_t{o.features_per_stage});
  print.add(std::uint64_t{o.features_per_tree});
  print.add(std::uint64_t{o.negatives});
  print.add(o.seed);
  return print;
}

StageReport
reportOf(const JsonValue& json)
{
  return {(json / "trees").count(),
          (json / "positives").count(),
          (json / "negatives").count(),
          (json / "hit_rate").number(),
          (json / "false_alarm").number(),
          (json / "background").number()};
}

Json
toJson(const StageReport& stage)
{
  return {{"trees", stage.trees},
          {"positives", stage.positives},
          {"negatives", stage.negatives},
          {"hit_rate", stage.hit_rate},
          {"false_alarm", stage.false_alarm},
          {"background", stage.background}};
}

} // namespace

TrainingState::TrainingState(std::filesystem::path folder,
                             const std::vector<GrayImage>& positives,
                             const std::vector<BackgroundImage>& backgrounds,
                             const CascadeTrainingOptions& options)
: folder_(std::move(folder))
{
  if (folder_.empty())
    return;
  Fingerprint print = of(options);
  for (const auto& positive : positives)
    print.add(positive);
  for (const auto& background : backgrounds) // gates derive from the images' scans
    print.add(background.image);
  fingerprint_ = print.text();
}

void
TrainingState::load(CascadeTraining& training) const
{
  const std::filesystem::path file = folder_ / "training.json";
  if (folder_.empty() || !text::isThere(file))
    return;
  const JsonValue json = readJson(file);
  if (const auto schema = json.find("schema_version")) // missing in older files
    schema->require(schema->integer() == kTrainingSchema,
                    std::to_string(kTrainingSchema));
  if ((json / "fingerprint").text() != fingerprint_)
    throw IoFailed(file.string() + ": belongs to a training with different images or "
                                   "options; remove the folder or give a new one");
  std::vector<StageReport> reports;
  for (const auto& stage : (json / "stages").elements())
    reports.push_back(reportOf(stage));
  HaarCascade cascade = readCascade(folder_ / "cascade.xml");
  // The cascade may be ahead by one stage, if writing of the second file was
  // interrupted.
  cascade.stages.resize(std::min(cascade.stages.size(), reports.size()));
  reports.resize(cascade.stages.size());
  training.cascade = std::move(cascade);
  training.stages = std::move(reports);
  training.resumed_stages = training.stages.size();
}

void
TrainingState::save(const CascadeTraining& training) const
{
  if (folder_.empty())
    return;
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error)
    throw IoFailed(folder_.string() + ": cannot be made: " + error.message());
  writeCascade(folder_ / "cascade.xml", training.cascade);
  Json stages = Json::array();
  for (const auto& stage : training.stages)
    stages.push_back(toJson(stage));
  const Json json = {{"schema_version", kTrainingSchema},
                     {"fingerprint", fingerprint_},
                     {"stages", stages}};
  writeJson(folder_ / "training.json", json);
}

} // namespace pcl6d::object_localization
