// SPDX-License-Identifier: BSD-3-Clause
// How many objects a detector finds and how often it errs: a model at random free places
// of simulated flats (scene rooms), one at a time. Usage: measure_detection MODEL
// RANGE.xml REFLECTANCE.xml [first seed] [last seed]. Prints the table of
// share/doc/objects.md.
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/random.h>
#include <pcl6d/io/mesh_io.h>
#include <pcl6d/object_localization/cascade_file.h>
#include <pcl6d/object_localization/object_detector.h>
#include <pcl6d/scanner/scanner_presets.h>
#include <pcl6d/scanner/scene_bodies.h>
#include <pcl6d/scanner/simulator.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace {
using namespace pcl6d;
constexpr std::uint32_t kObject = 99999;
constexpr double kMinVisible = 0.4;

/** A scan with the object in it. */
struct Case {
  Points points;
  std::vector<float> reflectance;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero(); // of the object, scan's frame [m]
  double visible = 0; // share of the samples that it would have alone
};

/** \return samples on the object */
std::size_t
countObject(const RangeScan& scan, const TriangleScene& scene)
{
  std::size_t count = 0;
  for (const auto& sample : scan.samples)
    count += std::isfinite(sample.range) &&
                     scene.surfaces[scene.triangles[sample.triangle].surface].object ==
                         kObject
                 ? 1
                 : 0;
  return count;
}

/** \return T_scene_object, if the place is free */
std::optional<Eigen::Isometry3d>
freePlace(const RayCaster& scene,
          const Eigen::Isometry3d& T_scene_scan,
          const Eigen::AlignedBox3d& box,
          Random& random)
{
  const SinCos way = portableSinCos(random.uniform(-M_PI, M_PI));
  const SinCos turn = portableSinCos(random.uniform(-M_PI, M_PI));
  const double distance = random.uniform(1.5, 5);
  Eigen::Vector3d place = T_scene_scan.translation();
  place.head<2>() += distance * Eigen::Vector2d(way.cos, way.sin);
  const auto floor = scene.cast({place, -Eigen::Vector3d::UnitZ()}, 3);
  if (!floor || floor->range < 0.3) // on a piece of furniture
    return {};
  place.z() -= floor->range;
  const double radius = box.sizes().head<2>().norm() / 2 + 0.05;
  for (double height = 0.1; height < box.sizes().z(); height += 0.1)
    for (int i = 0; i < 16; ++i) {
      const SinCos side = portableSinCos(i * M_PI / 8);
      const Eigen::Vector3d start = place + height * Eigen::Vector3d::UnitZ();
      if (scene.cast({start, {side.cos, side.sin, 0}}, radius))
        return {};
    }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear().topLeftCorner<2, 2>() << turn.cos, -turn.sin, turn.sin, turn.cos;
  pose.translation() = place;
  return pose;
}

std::optional<Case>
makeCase(const Simulator& simulator,
         const TriangleMesh& mesh,
         const ScannerPreset& scanner,
         std::size_t index,
         Random& random)
{
  Eigen::AlignedBox3d box;
  for (const auto& vertex : mesh.vertices)
    box.extend(vertex);
  const Eigen::Isometry3d T_scene_scan =
      simulator.sceneFromWorld() * simulator.truth().poses[index];
  const auto pose = freePlace(simulator.caster(), T_scene_scan, box, random);
  if (!pose)
    return {};
  Surface material;
  material.object = kObject;
  material.reflectance = random.uniform(0.3, 0.8);
  TriangleScene alone, all = simulator.caster().scene();
  addMesh(alone, mesh, *pose, material);
  addMesh(all, mesh, *pose, material);
  RangeOptions range = scanner.range;
  range.noise = 0.01;
  range.seed = static_cast<std::uint64_t>(random.uniform() * 1e9);
  const RayCaster caster(all);
  const RangeScan scan = castScan(caster, *scanner.scanner, T_scene_scan, range);
  const auto possible = countObject(
      castScan(RayCaster(alone), *scanner.scanner, T_scene_scan, range), alone);
  Case result;
  for (const auto& p : toPointCloud(scan, *scanner.scanner))
    if (std::isfinite(p.x)) {
      result.points.push_back(p.getVector3fMap());
      result.reflectance.push_back(p.intensity);
    }
  result.middle = T_scene_scan.inverse() * (*pose * box.center());
  result.visible = possible < 25 ? 0
                                 : static_cast<double>(countObject(scan, all)) /
                                       static_cast<double>(possible);
  return result;
}

struct Tally {
  std::string name;
  ObjectDetector detector;
  int objects = 0, found = 0, alarms = 0, scans = 0;
  double seconds = 0;

  void
  add(const Case& c)
  {
    const auto start = std::chrono::steady_clock::now();
    const auto detected = detector.detect(c.points, c.reflectance);
    seconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    bool hit = false;
    for (const auto& d : detected) {
      const auto place = detector.views().place(d.view, c.middle);
      const bool is_object = place.depth > 0 &&
                             std::abs(d.range - c.middle.norm()) < 0.7 &&
                             place.x > d.box.x && place.x < d.box.x + d.box.width &&
                             place.y > d.box.y && place.y < d.box.y + d.box.height;
      hit = hit || is_object;
      alarms += is_object ? 0 : 1;
    }
    ++scans;
    if (c.visible > kMinVisible) {
      ++objects;
      found += hit ? 1 : 0;
    }
  }
};
} // namespace

int
main(int argc, char** argv)
try {
  if (argc < 4)
    return std::puts("usage: measure_detection MODEL RANGE.xml REFLECTANCE.xml [FIRST] "
                     "[LAST]"),
           2;
  const TriangleMesh mesh = readMesh(argv[1]);
  const HaarCascade range = readCascade(argv[2]), reflectance = readCascade(argv[3]);
  const std::uint64_t first = argc > 4 ? std::strtoull(argv[4], nullptr, 10) : 11;
  const std::uint64_t last = argc > 5 ? std::strtoull(argv[5], nullptr, 10) : 30;
  DetectorOptions both, either;
  either.rule = DetectionRule::kOr;
  std::vector<Tally> tallies = {{"range", ObjectDetector(range)},
                                {"reflectance", ObjectDetector(reflectance)},
                                {"and", ObjectDetector(range, both, reflectance)},
                                {"or", ObjectDetector(range, either, reflectance)}};
  const ScannerPreset scanner = scannerByName("rotating");
  for (std::uint64_t seed = first; seed <= last; ++seed) {
    SimulationOptions options;
    options.num_scans = 10;
    options.scanner = scanner.scanner;
    options.seed = seed;
    const Simulator simulator(builtInScene("rooms", seed), options);
    Random random(seed);
    for (std::size_t i = 0; i < 10; i += 2)
      for (int tries = 0; tries < 100; ++tries)
        if (const auto made = makeCase(simulator, mesh, scanner, i, random)) {
          for (auto& tally : tallies)
            tally.add(*made);
          break;
        }
  }
  std::puts(
      "| detector | objects | found | recall | false per scan | seconds per scan |");
  for (const auto& t : tallies)
    std::printf("| %s | %d | %d | %.3f | %.3f | %.3f |\n",
                t.name.c_str(),
                t.objects,
                t.found,
                t.objects == 0 ? 0.0 : double(t.found) / t.objects,
                double(t.alarms) / t.scans,
                t.seconds / t.scans);
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "measure_detection: error: %s\n", e.what());
  return 1;
}
