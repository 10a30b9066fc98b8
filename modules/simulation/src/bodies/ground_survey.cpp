// SPDX-License-Identifier: BSD-3-Clause
#include "bodies/ground_area.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/number_range.h>
#include <pcl6d/common/require.h>
#include <pcl6d/simulation/ground_survey.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace pcl6d {
using namespace simulation;

namespace {
constexpr double kSurveyCell =
    0.25; // [m] holds a floor point of most scanners 10 m away
constexpr double kLargestCell = 0.5;
constexpr double kLayer = 0.05; // [m] of heights: a few times the noise of scanners
constexpr double kFlatFloor =
    0.1;                       // [m] spread of a floor's points, with errors of poses
constexpr double kFoot = 0.25; // [m] above the floor: lower objects are stepped over
constexpr std::uint32_t kSurePoints = 2;   // a single point may be a mixed pixel
constexpr std::uint32_t kFloorPoints = 50; // points of a floor around a scanner
constexpr double kNear = 6;       // [m] from the scanner, where it sees its floor
constexpr int kCloseRounds = 2;   // cells without points, closed from each side
constexpr int kCrossedRounds = 8; // rounds for cells that rays passed through
constexpr double kLevelRay = 1;   // [m] above or below the scanner: height of bodies
constexpr std::uint8_t kSureRays = 3;
constexpr std::size_t kRays = 20000; // rays followed per scan

std::int32_t
layerOf(double height)
{
  return clampedTo<std::int32_t>(std::floor(height / kLayer));
}

double
heightOf(std::int32_t layer)
{
  return (layer + 0.5) * kLayer;
}

GroundArea
areaOf(const std::vector<Eigen::Vector3d>& places, double reach)
{
  try {
    return areaAround(places, reach, kSurveyCell);
  } catch (const ComputeFailed&) {
    return areaAround(places, reach, kLargestCell);
  }
}
} // namespace

struct GroundSurvey::Impl {
  /// points by layer of height, sorted by layer
  using Heights = std::vector<std::pair<std::int32_t, std::uint32_t>>;

  std::vector<Eigen::Vector3d> places;
  GroundArea area;
  std::vector<char> within;
  std::vector<Heights> heights;              // of each cell
  std::vector<std::uint8_t> crossed;         // number of rays at body height
  std::vector<std::optional<double>> floors; // floor seen from each place [m]

  void
  count(std::size_t cell, double height);
  void
  follow(const Eigen::Vector3d& from, const Eigen::Vector3d& to);
  std::optional<double>
  floorNear(std::size_t cell, double expected, double tolerance) const;
  bool
  isCovered(std::size_t cell, double floor) const;
  void
  start(std::vector<double>& found, std::vector<std::size_t>& open) const;
  void
  spread(std::vector<double>& found, std::vector<std::size_t>& open) const;
  void
  closeGaps(std::vector<double>& found) const;
};

void
GroundSurvey::Impl::count(std::size_t cell, double height)
{
  const std::int32_t layer = layerOf(height);
  Heights& known = heights[cell];
  const auto at = std::lower_bound(
      known.begin(), known.end(), layer, [](const auto& entry, std::int32_t l) {
        return entry.first < l;
      });
  if (at != known.end() && at->first == layer)
    ++at->second;
  else
    known.insert(at, {layer, 1});
}

// Counts a ray for the cells it passes, except the last.
void
GroundSurvey::Impl::follow(const Eigen::Vector3d& from, const Eigen::Vector3d& to)
{
  const Eigen::Vector3d way = to - from;
  const double length = way.head<2>().norm();
  std::size_t last = area.size();
  for (double gone = area.cell; gone < length - area.cell; gone += area.cell / 2) {
    const double part = gone / length;
    const std::size_t cell = area.at((from + part * way).head<2>());
    if (cell >= area.size() || std::abs(part * way.z()) > kLevelRay)
      return;
    if (std::exchange(last, cell) != cell && crossed[cell] < kSureRays)
      ++crossed[cell];
  }
}

// The mean height of the lowest points near a position, if there are enough.
std::optional<double>
GroundSurvey::Impl::floorNear(std::size_t cell, double expected, double tolerance) const
{
  double sum = 0;
  std::uint32_t points = 0;
  double lowest = 0;
  for (const auto& [layer, count] : heights[cell]) {
    const double height = heightOf(layer);
    if (height < expected - tolerance - kLayer / 2)
      continue;
    if (height > expected + tolerance + kLayer / 2 ||
        (points > 0 && height > lowest + kFlatFloor))
      break;
    if (points == 0)
      lowest = height;
    sum += count * height;
    points += count;
  }
  if (points < kSurePoints)
    return std::nullopt;
  return sum / points;
}

// Whether an object stands on the floor of a cell, or hangs over it.
bool
GroundSurvey::Impl::isCovered(std::size_t cell, double floor) const
{
  std::uint32_t points = 0;
  for (const auto& [layer, count] : heights[cell])
    if (heightOf(layer) > floor + kFoot && heightOf(layer) < floor + kBodyHeight)
      points += count;
  return points >= kSurePoints;
}

void
GroundSurvey::Impl::start(std::vector<double>& found,
                          std::vector<std::size_t>& open) const
{
  const auto span = static_cast<int>(std::ceil(kNear / area.cell));
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!floors[i])
      continue;
    const std::size_t middle = area.at(places[i].head<2>());
    for (int dy = -span; dy <= span; ++dy)
      for (int dx = -span; dx <= span; ++dx) {
        const std::size_t cell = area.neighbour(middle, dx, dy);
        if (cell >= area.size() || !std::isnan(found[cell]))
          continue;
        if (const auto floor = floorNear(cell, *floors[i], kFlatFloor)) {
          found[cell] = *floor;
          open.push_back(cell);
        }
      }
  }
}

void
GroundSurvey::Impl::spread(std::vector<double>& found,
                           std::vector<std::size_t>& open) const
{
  for (std::size_t i = 0; i < open.size(); ++i)
    for (const int dy : {-1, 0, 1})
      for (const int dx : {-1, 0, 1}) {
        const std::size_t next = area.neighbour(open[i], dx, dy);
        if (next >= area.size() || within[next] == 0 || !std::isnan(found[next]) ||
            isCovered(open[i], found[open[i]]))
          continue;
        const double tolerance =
            kFlatFloor + kSteepest * (area.middle(next) - area.middle(open[i])).norm();
        if (const auto floor = floorNear(next, found[open[i]], tolerance)) {
          found[next] = *floor;
          open.push_back(next);
        }
      }
}

// Cells without floor between cells with a floor get their mean height, over wider gaps
// where rays passed through.
void
GroundSurvey::Impl::closeGaps(std::vector<double>& found) const
{
  for (int round = 0; round < kCrossedRounds; ++round) {
    const std::vector<double> before = found;
    for (std::size_t cell = 0; cell < found.size(); ++cell) {
      if (!std::isnan(before[cell]) || within[cell] == 0 ||
          (round >= kCloseRounds && crossed[cell] < kSureRays))
        continue;
      double sum = 0;
      int known = 0;
      for (const int dy : {-1, 0, 1})
        for (const int dx : {-1, 0, 1}) {
          const std::size_t next = area.neighbour(cell, dx, dy);
          if (next < area.size() && !std::isnan(before[next])) {
            sum += before[next];
            ++known;
          }
        }
      if (known >= 3)
        found[cell] = sum / known;
    }
  }
}

GroundSurvey::GroundSurvey(const std::vector<Eigen::Vector3d>& places, double reach)
: impl_(std::make_unique<Impl>())
{
  impl_->places = places;
  impl_->area = areaOf(places, reach);
  impl_->within = withinReach(impl_->area, places, reach);
  impl_->heights.resize(impl_->area.size());
  impl_->crossed.resize(impl_->area.size(), 0);
  impl_->floors.resize(places.size());
}

GroundSurvey::~GroundSurvey() = default;

void
GroundSurvey::add(std::size_t i, const Points& measured)
{
  require(i < impl_->places.size(), "place", i, "a place of the scanner");
  const Eigen::Vector3d& scanner = impl_->places[i];
  std::map<std::int32_t, std::uint32_t> below;
  const std::size_t step = measured.size() / kRays + 1;
  for (std::size_t k = 0; k < measured.size(); ++k) {
    const Eigen::Vector3d p = measured[k].cast<double>();
    if (k % step == 0)
      impl_->follow(scanner, p);
    const std::size_t cell = impl_->area.at(p.head<2>());
    if (cell >= impl_->area.size() || impl_->within[cell] == 0)
      continue;
    impl_->count(cell, p.z());
    if (p.z() < scanner.z() && (p - scanner).head<2>().norm() < kNear)
      ++below[layerOf(p.z())];
  }
  // The height of most points, in two adjacent layers, as a layer border may cut a
  // floor.
  std::uint32_t most = kFloorPoints - 1;
  for (const auto& [layer, count] : below) {
    const auto next = below.find(layer + 1);
    const std::uint32_t both = count + (next == below.end() ? 0 : next->second);
    if (both > most) {
      most = both;
      impl_->floors[i] = heightOf(layer) + kLayer / 2;
    }
  }
}

GroundMap
GroundSurvey::map() const
{
  std::vector<double> found(impl_->area.size(), kNoFloor);
  std::vector<std::size_t> open;
  impl_->start(found, open);
  if (open.empty())
    throw ComputeFailed("no ground found: no scan shows a level floor below itself");
  impl_->spread(found, open);
  impl_->closeGaps(found);
  for (std::size_t cell = 0; cell < found.size(); ++cell)
    if (!std::isnan(found[cell]) && impl_->isCovered(cell, found[cell]))
      found[cell] = kNoFloor;
  return GroundMap({impl_->area.low,
                    impl_->area.cell,
                    impl_->area.columns,
                    impl_->area.rows,
                    std::move(found)});
}

} // namespace pcl6d
