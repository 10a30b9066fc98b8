// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/random.h>
#include <pcl6d/simulation/cast_scan.h>

namespace pcl6d {
namespace {
// Takes one sample after the other.
class Sampler {
public:
  Sampler(const SceneView& view,
          const ScannerModel& scanner,
          const RangeErrorModel& model)
  : view_(view), scanner_(scanner), model_(model)
  {}

  RangeSample
  measure(int line, int sample, Random& random)
  {
    const Ray axis = scanner_.ray(line, sample);
    const double time = scanner_.time(line, sample);
    echoes_.clear();
    for (int i = 0; i < model_.numRays(); ++i)
      castRay(model_.ray(axis, i), time);
    return model_.measure(echoes_, random);
  }

private:
  void
  castRay(const Ray& ray, double time)
  {
    const auto hit = view_.cast(ray, time);
    if (!hit || !isLit(ray.origin + hit->range * ray.direction, time))
      return;
    const double reflectance = view_.surface(hit->triangle).reflectance;
    echoes_.push_back({hit->range,
                       reflectance * hit->cos_incidence,
                       hit->cos_incidence,
                       hit->triangle});
  }

  bool
  isLit(const Eigen::Vector3d& point, double time) const
  {
    constexpr double kSameSurface = 1e-6; // [m]
    const LightSource* const source = scanner_.lightSource();
    if (source == nullptr)
      return true;
    if (!source->lights(point))
      return false;
    const Eigen::Vector3d position = source->position();
    const double way = (point - position).norm();
    const auto first = view_.cast({position, (point - position) / way}, time);
    return !first || first->range > way - kSameSurface;
  }

  const SceneView& view_;
  const ScannerModel& scanner_;
  const RangeErrorModel& model_;
  std::vector<Echo> echoes_;
};
} // namespace

RangeScan
castScan(const SceneView& view,
         const ScannerModel& scanner,
         const RangeOptions& options,
         std::uint64_t scan_index)
{
  const RangeErrorModel model(options);
  RangeScan scan{scanner.numLines(), scanner.samplesPerLine(), {}};
  const auto num_lines = static_cast<std::size_t>(scan.num_lines);
  const auto per_line = static_cast<std::size_t>(scan.samples_per_line);
  scan.samples.resize(num_lines * per_line);
  const std::uint64_t scan_key = mixBits(mixBits(options.seed) ^ scan_index);
  parallelFor(num_lines, options.num_threads, [&](std::size_t line) {
    Random random(mixBits(scan_key ^ line)); // its own numbers, whoever does the line
    Sampler sampler(view, scanner, model);
    for (std::size_t i = 0; i < per_line; ++i)
      scan.samples[line * per_line + i] =
          sampler.measure(static_cast<int>(line), static_cast<int>(i), random);
  });
  return scan;
}

RangeScan
castScan(const RayCaster& caster,
         const ScannerModel& scanner,
         const Eigen::Isometry3d& T_scene_scan,
         const RangeOptions& options,
         std::uint64_t scan_index)
{
  return castScan(StandingView(caster, T_scene_scan), scanner, options, scan_index);
}

} // namespace pcl6d
