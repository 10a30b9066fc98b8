// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/measures.h"
#include "doctor/report/words.h"
#include "evaluate/pair_pose.h"

#include <pcl6d/common/median.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/filters/scan_parameters.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

namespace pcl6d::app {

namespace {
/** Least number of float steps per spacing; otherwise coordinates count as far away. A
 * thousandth of the spacing is far below the accuracy of registration. */
constexpr double kStepsPerSpacing = 1000;

/** A tenth of the spacing, like the tenth of a voxel in RegistrationVerifier: points
 * cannot distinguish poses closer together. */
constexpr double kToldApart = 0.1;

Eigen::Vector3d
medianOf(const DoctorCloud& cloud, const std::vector<std::size_t>& rows)
{
  Eigen::Vector3d middle;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const std::size_t i : rows)
      values.push_back(cloud.rows[i][axis]);
    middle[axis] = upperMedian(std::move(values));
  }
  return middle;
}

/** \return [m] from one float to the next, at a coordinate */
double
floatStep(double value)
{
  const float size = std::abs(static_cast<float>(value));
  return std::nextafter(size, std::numeric_limits<float>::infinity()) - size;
}

/** \return the number of distinct coordinates on each axis, as float */
std::array<std::size_t, 3>
valuesOf(const DoctorCloud& cloud, const std::vector<std::size_t>& rows)
{
  std::array<std::size_t, 3> counts{};
  for (int axis = 0; axis < 3; ++axis) {
    std::set<float> values;
    for (const std::size_t i : rows)
      values.insert(static_cast<float>(cloud.rows[i][axis]));
    counts[static_cast<std::size_t>(axis)] = values.size();
  }
  return counts;
}

std::size_t
duplicatesAmong(const DoctorCloud& cloud, const std::vector<std::size_t>& rows)
{
  std::vector<Eigen::Vector3f> points; // as PCL has them
  for (const std::size_t i : rows)
    points.push_back(cloud.rows[i].cast<float>());
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  });
  const auto end = std::unique(points.begin(), points.end());
  return static_cast<std::size_t>(points.end() - end);
}

/** Position of the scanner: inside the cloud, or outside by at most the size of the cloud. */
ScannerPlace
scannerOf(const DoctorCloud& cloud,
          const CloudMeasures& of,
          const std::optional<Eigen::Vector3d>& given)
{
  if (given)
    return {*given, "given", true};
  const double size = of.box.diagonal().norm();
  if (of.box.exteriorDistance(Eigen::Vector3d::Zero().eval()) <= size)
    return {Eigen::Vector3d::Zero(), "0 of its coordinates", true};
  if (cloud.viewpoint &&
      of.box.exteriorDistance(cloud.viewpoint->translation().eval()) <= size)
    return {cloud.viewpoint->translation(), "its VIEWPOINT", true};
  return {of.middle, "its middle: no VIEWPOINT is given", false};
}

void
measureRanges(const DoctorCloud& cloud,
              const std::vector<std::size_t>& rows,
              CloudMeasures& of)
{
  Points seen;
  for (const std::size_t i : rows)
    seen.push_back((cloud.rows[i] - of.scanner.place).cast<float>());
  of.no_return = noReturnRange(seen);
  if (of.no_return)
    of.num_no_return = static_cast<std::size_t>(
        std::count_if(seen.begin(), seen.end(), [&](const Eigen::Vector3f& p) {
          return static_cast<double>(p.norm()) > 0.999 * *of.no_return;
        }));
}

/** Sets an offset in whole metres if float is too coarse for the spacing, and at least
 * three bits finer near the middle of the cloud. */
void
chooseOffset(DoctorCloud& cloud, const CloudMeasures& of)
{
  constexpr double kFiner = 8;
  const double step_there = floatStep(0.5 * of.box.diagonal().norm());
  if (of.float_step * kStepsPerSpacing > of.spacing &&
      kFiner * step_there <= of.float_step)
    cloud.offset = of.middle.array().round();
}

CloudMeasures
measure(DoctorCloud& cloud, const std::optional<Eigen::Vector3d>& origin)
{
  CloudMeasures of;
  of.not_finite = cloud.numNotFinite();
  const auto rows = cloud.finiteRows(true);
  of.points = rows.size();
  if (rows.empty())
    return of;
  of.middle = medianOf(cloud, rows);
  for (const std::size_t i : rows)
    of.box.extend(cloud.rows[i]);
  of.float_step = floatStep(
      std::max(of.box.min().cwiseAbs().maxCoeff(), of.box.max().cwiseAbs().maxCoeff()));
  of.values = valuesOf(cloud, rows);
  of.duplicates = duplicatesAmong(cloud, rows);
  cloud.offset = of.middle.array().round(); // the spacing must not suffer from float
  const Points near = cloud.localPoints(rows);
  cloud.offset.setZero();
  of.spread = medianSpread(near);
  of.spacing = medianSpacing(near);
  of.scanner = scannerOf(cloud, of, origin);
  measureRanges(cloud, rows, of);
  chooseOffset(cloud, of);
  return of;
}

void
readGuess(const DoctorSettings& s, DoctorPair& pair)
{
  pair.guess_given = Eigen::Isometry3d::Identity();
  pair.guess_words = "the identity";
  if (s.guess.empty())
    return;
  pair.guess_words = "--guess";
  pair.guess_given = std::filesystem::is_regular_file(s.guess)
                         ? poseFromFile(s.guess)
                         : poseFromText("--guess", s.guess);
}

/** Clouds in one far frame get a common offset, which preserves the identity. */
void
joinOffsets(DoctorPair& pair)
{
  if (pair.source.offset.isZero() || pair.target.offset.isZero())
    return;
  const double size = pair.of_source.box.merged(pair.of_target.box).diagonal().norm();
  // [m] as worldOffset(): float steps reach a millimetre
  constexpr double kFrame = 10000;
  if (size < kFrame)
    pair.source.offset = pair.target.offset;
}

void
deriveSettings(const DoctorSettings& s, DoctorPair& pair)
{
  constexpr double kCellSpacings = 6; // 36 points of a surface in a cell; NDT needs 6
  pair.spacing = std::max(pair.of_source.spacing, pair.of_target.spacing);
  if (pair.spacing <= 0)
    pair.spacing = std::max(pair.of_source.spread, pair.of_target.spread);
  const double derived_distance = pair.maxDistanceAt(pair.at_start);
  pair.max_distance = s.max_distance.value_or(derived_distance);
  pair.max_distance_why =
      s.max_distance ? "given"
      : derived_distance > 3 * pair.spacing
          ? "twice the median distance to the target at the start, " +
                metres(pair.at_start.median)
          : "three times the spacing, " + metres(pair.spacing);
  pair.resolution = std::max(kCellSpacings * pair.spacing, pair.max_distance);
  const auto derived =
      deriveScanParameters({}, {pair.seen(pair.target), pair.seen(pair.source)});
  pair.voxel = derived.voxel.value;
  pair.voxel_why = derived.voxel.why;
  pair.reach = derived.max_range.value;
}
} // namespace

Eigen::Isometry3d
DoctorPair::toLocal(const Eigen::Isometry3d& pose) const
{
  return Eigen::Translation3d(-target.offset) * pose *
         Eigen::Translation3d(source.offset);
}

Eigen::Isometry3d
DoctorPair::toFull(const Eigen::Isometry3d& pose) const
{
  return Eigen::Translation3d(target.offset) * pose *
         Eigen::Translation3d(-source.offset);
}

double
DoctorPair::maxDistanceAt(const PoseFit& fit) const
{
  constexpr double kSpacings = 3;     // to meet points beside the nearest
  constexpr double kBeyondMedian = 2; // half of the points are nearer than the median
  return std::max(kSpacings * spacing, kBeyondMedian * fit.median);
}

Points
DoctorPair::seen(const DoctorCloud& cloud) const
{
  const bool is_source = &cloud == &source;
  Points points = is_source ? source_points : target_points;
  const CloudMeasures& of = is_source ? of_source : of_target;
  const Eigen::Vector3f scanner = (of.scanner.place - cloud.offset).cast<float>();
  for (auto& p : points)
    p -= scanner;
  return points;
}

double
DoctorPair::tolerance() const
{
  return kToldApart * spacing;
}

DoctorPair::Difference
DoctorPair::between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const
{
  const Eigen::Vector3d middle = of_source.middle - source.offset;
  Difference d;
  d.translation = (a * middle - b * middle).norm();
  d.rotation = distanceBetween(a, b).rotation;
  d.shift = d.translation + d.rotation * of_source.spread;
  return d;
}

PoseFit
DoctorPair::fitAt(const Eigen::Isometry3d& pose, double limit) const
{
  PoseFit fit;
  if (!tree || source_points.empty() || tree->size() == 0)
    return fit;
  std::vector<double> distances;
  double sum_sq = 0;
  std::size_t within = 0;
  for (const auto& p : source_points) {
    const Eigen::Vector3f q = (pose * p.cast<double>()).cast<float>();
    const Neighbour found = tree->nearest(q, std::numeric_limits<float>::max());
    if (found.index < 0)
      continue;
    distances.push_back(std::sqrt(static_cast<double>(found.distance_sq)));
    within += distances.back() <= limit ? 1 : 0;
    const double counted = std::min(distances.back(), limit);
    sum_sq += counted * counted;
  }
  const auto count = static_cast<double>(source_points.size());
  fit.share = static_cast<double>(within) / count;
  fit.median = upperMedian(std::move(distances));
  fit.misfit = std::sqrt(sum_sq / count);
  return fit;
}

DoctorPair
loadPair(const DoctorSettings& s)
{
  DoctorPair pair;
  pair.source = readDoctorCloud(s.source, s.format);
  pair.target = readDoctorCloud(s.target, s.format);
  if (!s.indices.empty())
    pair.source.indices = readRowNumbers(s.indices, pair.source);
  pair.of_source = measure(pair.source, s.source_origin);
  pair.of_target = measure(pair.target, s.target_origin);
  joinOffsets(pair);
  readGuess(s, pair);
  pair.start = pair.toLocal(pair.guess_given);
  pair.source_points = pair.source.localPoints(pair.source.finiteRows(true));
  pair.target_points = pair.target.localPoints(pair.target.finiteRows(true));
  pair.tree.emplace(pair.target_points, 1U);
  constexpr double kNoLimit = std::numeric_limits<double>::max();
  pair.at_start = pair.fitAt(pair.start, kNoLimit);
  if (!pair.canBeMatched())
    return pair;
  deriveSettings(s, pair);
  pair.at_start = pair.fitAt(pair.start, pair.max_distance);
  return pair;
}

} // namespace pcl6d::app
