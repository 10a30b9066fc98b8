// SPDX-License-Identifier: BSD-3-Clause
// How many objects the detectors of a model store find and how often they err, in
// simulated flats in which all its models stand about (object_rooms.h). Usage:
// measure_detection STORE [first seed] [last seed] [scans of each] [min_neighbours_range]
// [min_neighbours_reflectance]. Prints the table of share/doc/objects.md.
#include "object_rooms.h"

#include <pcl6d/object_localization/cascade_file.h>
#include <pcl6d/object_localization/object_detector.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>

namespace {
using namespace pcl6d;
constexpr double kMinVisible = 0.4;

/** \return whether a box holds the middle of the object and is about as far */
bool
shows(const DetectionViews& views,
      const DetectedObject& d,
      const Eigen::Vector3d& middle,
      double diameter)
{
  const auto place = views.place(d.view, middle);
  return place.depth > 0 &&
         std::abs(d.range - middle.norm()) < std::max(0.4, diameter / 2) &&
         place.x > d.box.x && place.x < d.box.x + d.box.width && place.y > d.box.y &&
         place.y < d.box.y + d.box.height;
}

/** How one kind of detector did on one class. */
struct Tally {
  std::string name;
  std::vector<DetectionSource> sources; // what it counts of both channels together
  int objects = 0, found = 0, alarms = 0;

  void
  add(const test::ObjectRoom& room,
      const std::vector<DetectedObject>& all,
      const DetectionViews& views,
      std::size_t model,
      const ObjectModel& shape)
  {
    std::vector<DetectedObject> detected;
    for (const auto& d : all)
      if (std::find(sources.begin(), sources.end(), d.source) != sources.end())
        detected.push_back(d);
    alarms += static_cast<int>(detected.size());
    for (const auto& object : room.objects) {
      if (object.model != model)
        continue;
      const Eigen::Vector3d middle = object.T_scan_object * shape.box().center();
      const auto hits =
          std::count_if(detected.begin(), detected.end(), [&](const DetectedObject& d) {
            return shows(views, d, middle, shape.diameter());
          });
      alarms -= static_cast<int>(hits);
      objects += object.visible > kMinVisible ? 1 : 0;
      found += object.visible > kMinVisible && hits > 0 ? 1 : 0;
    }
  }
};

/** All detectors of one class. What range sees is part of OR, and AND is. */
struct ClassTally {
  using Source = DetectionSource;
  std::size_t model;
  ObjectDetector either;
  ObjectDetector reflectance;
  Tally by_reflectance = {"reflectance", {Source::kReflectance}};
  std::vector<Tally> tallies = {
      {"range", {Source::kRange, Source::kBoth}},
      {"and", {Source::kBoth}},
      {"or", {Source::kRange, Source::kReflectance, Source::kBoth}}};
  double seconds = 0;
  int scans = 0;

  void
  add(const test::ObjectRoom& room, const ObjectModel& shape)
  {
    const auto start = std::chrono::steady_clock::now();
    const auto detected = either.detect(room.points, room.reflectance);
    seconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    ++scans;
    for (auto& tally : tallies)
      tally.add(room, detected, either.views(), model, shape);
    by_reflectance.add(room,
                       reflectance.detect(room.points, room.reflectance),
                       reflectance.views(),
                       model,
                       shape);
  }

  void
  print(const std::string& object_class) const
  {
    for (const Tally* const t :
         {&tallies[0], &by_reflectance, &tallies[1], &tallies[2]})
      std::printf("| %s | %s | %d | %d | %.3f | %.2f |\n",
                  object_class.c_str(),
                  t->name.c_str(),
                  t->found,
                  t->objects,
                  t->objects == 0 ? 0.0 : double(t->found) / t->objects,
                  double(t->alarms) / scans);
    std::fprintf(
        stderr, "%s: %.3f s per scan\n", object_class.c_str(), seconds / scans);
  }
};

std::vector<ClassTally>
talliesOf(const std::vector<StoredModel>& models, const DetectorOptions& either)
{
  std::vector<ClassTally> tallies;
  for (std::size_t m = 0; m < models.size(); ++m)
    if (models[m].range_cascade && models[m].reflectance_cascade) {
      const HaarCascade range = readCascade(*models[m].range_cascade);
      const HaarCascade reflectance = readCascade(*models[m].reflectance_cascade);
      tallies.push_back({m,
                         ObjectDetector(range, either, reflectance),
                         ObjectDetector(reflectance, either)});
    }
  return tallies;
}

int
number(int argc, char** argv, int place, int otherwise)
{
  return argc > place ? std::atoi(argv[place]) : otherwise;
}
} // namespace

int
main(int argc, char** argv)
try {
  if (argc < 2)
    return std::puts("usage: measure_detection STORE [FIRST] [LAST] [SCANS] "
                     "[NEIGHBOURS_RANGE] [NEIGHBOURS_REFLECTANCE]"),
           2;
  std::vector<StoredModel> models;
  for (const auto& folder : listModels(argv[1]))
    models.push_back(readStoredModel(folder));
  DetectorOptions either;
  either.rule = DetectionRule::kOr;
  either.min_neighbours_range = number(argc, argv, 5, either.min_neighbours_range);
  either.min_neighbours_reflectance =
      number(argc, argv, 6, either.min_neighbours_reflectance);
  std::vector<ClassTally> tallies = talliesOf(models, either);
  test::ObjectRoomOptions options;
  options.scans = number(argc, argv, 4, 5);
  const int last = number(argc, argv, 3, 30);
  for (int seed = number(argc, argv, 2, 11); seed <= last; ++seed)
    for (const auto& room :
         test::objectRooms(models, static_cast<std::uint64_t>(seed), options))
      for (auto& tally : tallies)
        tally.add(room, models[tally.model].model);
  std::puts("| class | detector | found | of | recall | false boxes per scan |\n"
            "|---|---|---|---|---|---|");
  for (const auto& tally : tallies)
    tally.print(models[tally.model].model.objectClass());
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "measure_detection: error: %s\n", e.what());
  return 1;
}
