// SPDX-License-Identifier: BSD-3-Clause
// How many objects the detectors of a model store find and how often they err, in
// simulated flats in which all its models stand about (object_rooms.h). Usage:
// measure_detection STORE [first seed] [last seed]. Prints the table of
// share/doc/objects.md.
#include "object_rooms.h"

#include <pcl6d/object_localization/cascade_file.h>
#include <pcl6d/object_localization/object_detector.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

namespace {
using namespace pcl6d;
constexpr double kMinVisible = 0.4;

/** How one detector did on one class. */
struct Tally {
  std::size_t model;
  std::string name;
  ObjectDetector detector;
  int objects = 0, found = 0, alarms = 0, scans = 0;
  double seconds = 0;

  void
  add(const test::ObjectRoom& room, const StoredModel& stored)
  {
    const auto start = std::chrono::steady_clock::now();
    const auto detected = detector.detect(room.points, room.reflectance);
    seconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    ++scans;
    alarms += static_cast<int>(detected.size());
    for (const auto& object : room.objects) {
      if (object.model != model)
        continue;
      const Eigen::Vector3d middle = object.T_scan_object * stored.model.box().center();
      int hits = 0;
      for (const auto& d : detected)
        hits += shows(d, middle, stored.model.diameter()) ? 1 : 0;
      alarms -= hits;
      objects += object.visible > kMinVisible ? 1 : 0;
      found += object.visible > kMinVisible && hits > 0 ? 1 : 0;
    }
  }

  /** \return whether a box holds the middle of the object and is about as far */
  bool
  shows(const DetectedObject& d, const Eigen::Vector3d& middle, double diameter) const
  {
    const auto place = detector.views().place(d.view, middle);
    return place.depth > 0 &&
           std::abs(d.range - middle.norm()) < std::max(0.4, diameter / 2) &&
           place.x > d.box.x && place.x < d.box.x + d.box.width && place.y > d.box.y &&
           place.y < d.box.y + d.box.height;
  }
};

std::vector<Tally>
talliesOf(const std::vector<StoredModel>& models)
{
  DetectorOptions both, either;
  either.rule = DetectionRule::kOr;
  std::vector<Tally> tallies;
  for (std::size_t m = 0; m < models.size(); ++m) {
    if (!models[m].range_cascade || !models[m].reflectance_cascade)
      continue;
    const HaarCascade range = readCascade(*models[m].range_cascade);
    const HaarCascade reflectance = readCascade(*models[m].reflectance_cascade);
    tallies.push_back({m, "range", ObjectDetector(range)});
    tallies.push_back({m, "reflectance", ObjectDetector(reflectance)});
    tallies.push_back({m, "and", ObjectDetector(range, both, reflectance)});
    tallies.push_back({m, "or", ObjectDetector(range, either, reflectance)});
  }
  return tallies;
}

std::uint64_t
number(int argc, char** argv, int place, std::uint64_t otherwise)
{
  return argc > place ? std::strtoull(argv[place], nullptr, 10) : otherwise;
}
} // namespace

int
main(int argc, char** argv)
try {
  if (argc < 2)
    return std::puts("usage: measure_detection STORE [FIRST] [LAST]"), 2;
  std::vector<StoredModel> models;
  for (const auto& folder : listModels(argv[1]))
    models.push_back(readStoredModel(folder));
  std::vector<Tally> tallies = talliesOf(models);
  const std::uint64_t last = number(argc, argv, 3, 30);
  for (std::uint64_t seed = number(argc, argv, 2, 11); seed <= last; ++seed)
    for (const auto& room : test::objectRooms(models, seed))
      for (auto& tally : tallies)
        tally.add(room, models[tally.model]);
  std::puts("| class | detector | found | of | recall | false boxes per scan | seconds "
            "per scan |\n|---|---|---|---|---|---|---|");
  for (const auto& t : tallies)
    std::printf("| %s | %s | %d | %d | %.3f | %.2f | %.3f |\n",
                models[t.model].model.objectClass().c_str(),
                t.name.c_str(),
                t.found,
                t.objects,
                t.objects == 0 ? 0.0 : double(t.found) / t.objects,
                double(t.alarms) / t.scans,
                t.seconds / t.scans);
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "measure_detection: error: %s\n", e.what());
  return 1;
}
