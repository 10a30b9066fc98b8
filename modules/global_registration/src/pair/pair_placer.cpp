// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/global_registration/pair_placer.h>
#include <pcl6d/verification/prepared_scans.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace pcl6d {

namespace {
constexpr double kUnitTolerance = 1e-3;

void
requireUnitVector(const Eigen::Vector3d& v, const char* name)
{
  require(
      std::abs(v.norm() - 1) < kUnitTolerance, name, v.transpose(), "a unit vector");
}

/** Whether the bits of two point sets are equal, NaN included. */
bool
areSame(const Points& a, const Points& b)
{
  static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
  return a.size() == b.size() &&
         (a.empty() ||
          std::memcmp(a.data(), b.data(), a.size() * sizeof(Eigen::Vector3f)) == 0);
}
} // namespace

struct PairPlacer::Prepared {
  Points points;
  PreparedScans scans;
  std::unique_ptr<PlaceableScan> placeable;

  Prepared(const Points& measured,
           const PairPlacerOptions& options,
           const Eigen::Vector3d& up,
           const char* name)
  : points(measured)
  , scans(1,
          deriveScanParameters(options.parameters, {measured}),
          options.search.num_threads)
  {
    scans.set(0, measured, name);
    placeable = std::make_unique<PlaceableScan>(scans.scans().front(), up);
  }
};

void
PairPlacerOptions::validate() const
{
  search.validate();
  parameters.validate();
  requireUnitVector(target_up, "target_up");
  requireUnitVector(source_up, "source_up");
}

PairPlacer::PairPlacer() = default;
PairPlacer::~PairPlacer() = default;
PairPlacer::PairPlacer(PairPlacer&&) noexcept = default;
PairPlacer&
PairPlacer::operator=(PairPlacer&&) noexcept = default;

void
PairPlacer::setOptions(const PairPlacerOptions& options)
{
  options.validate();
  options_ = options;
  target_.reset();
  source_.reset();
}

const PairPlacer::Prepared&
PairPlacer::prepared(std::unique_ptr<Prepared>& kept,
                     const Points& points,
                     const Eigen::Vector3d& up,
                     const char* name)
{
  if (!kept || !areSame(kept->points, points)) {
    kept.reset(); // also after a failure
    kept = std::make_unique<Prepared>(points, options_, up, name);
  }
  return *kept;
}

PairPlacement
PairPlacer::place(const Points& target, const Points& source)
{
  PairPlacement found;
  try {
    const PlaceableScan& first =
        *prepared(target_, target, options_.target_up, "the target").placeable;
    const PlaceableScan& second =
        *prepared(source_, source, options_.source_up, "the source").placeable;
    found.result = placeScan(first, second, options_.search);
    if (!found.result.candidates.empty())
      found.T_target_source =
          refinePlace(first,
                      second,
                      found.result.candidates.front().T_first_second,
                      options_.search.num_threads);
  } catch (const ComputeFailed& e) {
    found.result.rejection = Rejection::stated(e.what());
  }
  return found;
}

} // namespace pcl6d
