// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/random.h>
#include <pcl6d/simulation/cast_scan.h>

namespace pcl6d {
namespace {
// The first surface that stops a ray. \param[in] goesThrough called with each surface
// in the way: the hit, the surface and its number from 0
template <typename Decide>
std::optional<RayHit>
firstReturn(const SceneView& view,
            const Ray& ray,
            double time,
            const Decide& goesThrough)
{
  constexpr double kBeyond = 1e-6; // [m] behind a surface that the ray passed through
  double gone = 0;
  for (std::uint64_t n = 0;; ++n) {
    auto hit = view.cast({ray.origin + gone * ray.direction, ray.direction}, time);
    if (!hit)
      return hit;
    hit->range += gone;
    if (!goesThrough(*hit, view.surface(hit->triangle), n))
      return hit;
    gone = hit->range + kBeyond;
  }
}

// A number in [0, 1), a function of the key alone.
double
shareOf(std::uint64_t key)
{
  return static_cast<double>(mixBits(key) >> 11) * 0x1.0p-53;
}

// Takes samples one after another.
class Sampler {
public:
  Sampler(const SceneView& view,
          const ScannerModel& scanner,
          const RangeErrorModel& model,
          std::uint64_t line_key)
  : view_(view), scanner_(scanner), model_(model), pane_key_(mixBits(~line_key))
  {}

  RangeSample
  measure(int line, int sample, Random& random)
  {
    const Ray axis = scanner_.ray(line, sample);
    const double time = scanner_.time(line, sample);
    echoes_.clear();
    for (int i = 0; i < model_.numRays(); ++i) {
      const auto number = static_cast<std::uint64_t>(sample) *
                              static_cast<std::uint64_t>(model_.numRays()) +
                          static_cast<std::uint64_t>(i);
      castRay(model_.ray(axis, i), time, mixBits(pane_key_ ^ number));
    }
    return model_.measure(echoes_, random);
  }

private:
  // \param[in] key of the random numbers for panes, separate from the noise, which they
  // leave unchanged
  void
  castRay(const Ray& ray, double time, std::uint64_t key)
  {
    const auto hit = firstReturn(
        view_, ray, time, [key](const RayHit& at, const Surface& pane, auto n) {
          return pane.transmittance > 0 &&
                 (at.is_from_behind || shareOf(key ^ n) < pane.transmittance);
        });
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
    const auto first =
        firstReturn(view_,
                    {position, (point - position) / way},
                    time,
                    [](const RayHit&, const Surface& pane, auto) {
                      return pane.transmittance > 0; // no shadow of panes
                    });
    return !first || first->range > way - kSameSurface;
  }

  const SceneView& view_;
  const ScannerModel& scanner_;
  const RangeErrorModel& model_;
  std::uint64_t pane_key_;
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
    const std::uint64_t line_key = mixBits(scan_key ^ line);
    Random random(line_key); // numbers of the line, independent of the thread
    Sampler sampler(view, scanner, model, line_key);
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
