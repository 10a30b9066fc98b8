// SPDX-License-Identifier: BSD-3-Clause
// How many objects are found in furnished flats (scene rooms), how precisely, and how often
// something else is taken for one. Usage: measure_localization STORE [first seed] [last
// seed] [scanner] [verbose]. Prints the table of share/doc/objects.md.
#include "object_rooms.h"

#include <pcl6d/common/median.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/object_localization/object_localizer.h>
#include <pcl6d/object_localization/object_proposals.h>
#include <pcl6d/plane_segmentation/segment_planes.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

namespace {
using namespace pcl6d;
constexpr double kMinVisible = 0.4;
constexpr double kNear = 0.1;               // [m] of an object that counts as found
constexpr double kTurned = 10 * M_PI / 180; // [rad] the same

struct Tally {
  int objects = 0, found = 0, hidden_found = 0, alarms = 0;
  std::vector<double> shifts, turns;
};

/** \return the angle between poses of an object that looks the same after some turns */
double
turnBetween(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, const ObjectSymmetry& s)
{
  if (s.isRound())
    return std::acos(std::clamp(a.col(2).dot(b.col(2)), -1.0, 1.0));
  double least = M_PI;
  for (int i = 0; i < s.turns; ++i)
    least = std::min(
        least,
        rotationAngle(Eigen::Matrix3d(
            a.transpose() * b *
            Eigen::AngleAxisd(2 * M_PI * i / s.turns, Eigen::Vector3d::UnitZ()))));
  return least;
}

std::vector<LocalizedObject>
locateAll(const std::vector<ObjectLocalizer>& localizers, const Points& points)
{
  const LocalizationScene scene(points);
  const PlaneCloud cloud(scene.points());
  const auto proposals = proposeObjects(cloud, segmentPlanes(cloud));
  std::vector<LocalizedObject> objects;
  for (const auto& localizer : localizers)
    for (auto& object : localizer.locate(scene, proposals))
      objects.push_back(std::move(object));
  return strongestObjects(std::move(objects));
}

void
compare(const test::ObjectRoom& room,
        const std::vector<LocalizedObject>& found,
        const std::vector<StoredModel>& models,
        std::vector<Tally>& tallies,
        bool verbose)
{
  std::vector<bool> is_true(found.size(), false);
  for (const auto& object : room.objects) {
    const ObjectModel& model = models[object.model].model;
    Tally& tally = tallies[object.model];
    const Eigen::Vector3d middle = model.box().center();
    const bool counts = object.visible > kMinVisible;
    tally.objects += counts ? 1 : 0;
    bool hit = false;
    for (std::size_t i = 0; i < found.size() && !hit; ++i) {
      const Eigen::Isometry3d& T = found[i].T_scene_object;
      const double shift = (T * middle - object.T_scan_object * middle).norm();
      const double turn =
          turnBetween(T.linear(), object.T_scan_object.linear(), model.symmetry());
      hit = found[i].object_class == model.objectClass() && shift < kNear &&
            turn < kTurned;
      if (verbose && shift < 0.5)
        std::printf(
            "   near %s: %s %.3f m %.1f deg, visible %.2f score %.2f points %zu\n",
            model.objectClass().c_str(),
            found[i].object_class.c_str(),
            shift,
            turn * 180 / M_PI,
            found[i].visible_fraction,
            found[i].score,
            found[i].points.size());
      if (!hit)
        continue;
      is_true[i] = true;
      if (counts) {
        tally.shifts.push_back(shift);
        tally.turns.push_back(turn);
      }
    }
    (counts ? tally.found : tally.hidden_found) += hit ? 1 : 0;
    if (verbose && counts && !hit)
      std::printf("  missed %s: visible %.2f, %zu samples, %.1f m away\n",
                  model.objectClass().c_str(),
                  object.visible,
                  object.samples,
                  object.T_scan_object.translation().norm());
  }
  for (std::size_t i = 0; i < found.size(); ++i)
    for (std::size_t m = 0; m < models.size() && !is_true[i]; ++m)
      if (models[m].model.objectClass() == found[i].object_class) {
        ++tallies[m].alarms;
        if (verbose)
          std::printf("  false %s: visible %.2f score %.2f rms %.3f points %zu\n",
                      found[i].object_class.c_str(),
                      found[i].visible_fraction,
                      found[i].score,
                      found[i].rms,
                      found[i].points.size());
      }
}

void
print(const std::string& name, const Tally& t, int scans)
{
  const auto median = [](const std::vector<double>& values) {
    return values.empty() ? 0.0 : upperMedian(values);
  };
  std::printf("| %s | %d | %d | %.1f %% | %d | %.3f | %.1f | %.2f |\n",
              name.c_str(),
              t.objects,
              t.found,
              t.objects == 0 ? 0.0 : 100.0 * t.found / t.objects,
              t.alarms,
              static_cast<double>(t.alarms) / scans,
              1000 * median(t.shifts),
              180 / M_PI * median(t.turns));
}
} // namespace

int
main(int argc, char** argv)
try {
  if (argc < 2)
    return std::puts("usage: measure_localization STORE [FIRST] [LAST] [SCANNER] [v]"),
           2;
  const std::uint64_t first = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 11;
  const std::uint64_t last = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 30;
  test::ObjectRoomOptions options;
  if (argc > 4)
    options.scanner = argv[4];
  std::vector<StoredModel> models;
  std::vector<ObjectLocalizer> localizers;
  for (const auto& folder : listModels(argv[1])) {
    models.push_back(readStoredModel(folder));
    localizers.emplace_back(models.back().model);
  }
  std::vector<Tally> tallies(models.size());
  int scans = 0;
  double seconds = 0;
  for (std::uint64_t seed = first; seed <= last; ++seed)
    for (const auto& room : test::objectRooms(models, seed, options)) {
      const auto start = std::chrono::steady_clock::now();
      const auto found = locateAll(localizers, room.points);
      seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
                     .count();
      if (argc > 5)
        std::printf("seed %d scan %d\n", static_cast<int>(seed), scans % options.scans);
      compare(room, found, models, tallies, argc > 5);
      ++scans;
    }
  std::puts("| class | objects | found | recall | false | per scan | position [mm] | "
            "rotation [deg] |\n|---|---|---|---|---|---|---|---|");
  Tally all;
  for (std::size_t m = 0; m < models.size(); ++m) {
    const Tally& t = tallies[m];
    print(models[m].model.objectClass(), t, scans);
    all.objects += t.objects;
    all.found += t.found;
    all.alarms += t.alarms;
    all.shifts.insert(all.shifts.end(), t.shifts.begin(), t.shifts.end());
    all.turns.insert(all.turns.end(), t.turns.begin(), t.turns.end());
  }
  print("all", all, scans);
  std::printf("%d scans, %.3f s each\n", scans, seconds / scans);
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "measure_localization: error: %s\n", e.what());
  return 1;
}
