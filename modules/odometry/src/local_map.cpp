// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/require.h>
#include <pcl6d/odometry/local_map.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
/** A plane has three parameters; twice this number of points gives a usable variance. */
constexpr double kLeastPoints = 6;

/** Points of a plane that fill their voxel spread by edge / sqrt(12) both ways; points on a line,
 * or in a corner of the voxel, spread less than a third of this value and fix no normal. */
constexpr double kLeastSpread = 0.1;

/** Least ratio of a plane's spread along its directions to the spread across
 * (SurfaceMapOptions). */
constexpr double kFlatness = 5;

/** A larger voxel is taken if its variance is at most this multiple of the smaller voxel's: the
 * variance of a few dozen points varies by this factor between equal surfaces. */
constexpr double kSameVariance = 1.5;

/** Least ratio of a plane's spread as the scanner sees it, which the noise of ranges does not widen,
 * to the spread across: a single scan line has 1, several have the ratio of their distance to the
 * noise; 2 is beyond chance. Drives with 1.5, 2 and 3 have the same errors of their steps; 5 loses
 * floors seen at a small angle. */
constexpr double kSeenFlatness = 2;

constexpr int kMostLevels = 8;

/** Voxels are numbered up to 2^20 either way (voxelKey()); the outermost voxel is left out. */
constexpr double kMostVoxels = 1048575;

Eigen::Vector3d
centreOf(VoxelKey key, double edge)
{
  return voxelCentre(key, edge).cast<double>();
}

/** \return [m^2] the smaller variance of points at right angles to their rays: of a single scan line,
 * about 0
 * \param[in] spread the lower triangle of their covariance */
double
varianceAcrossRays(const Eigen::Matrix3d& spread, const Eigen::Vector3d& ray)
{
  const Eigen::Vector3d a = ray.unitOrthogonal(), b = ray.cross(a);
  const Eigen::Vector3d of_a = spread.selfadjointView<Eigen::Lower>() * a,
                        of_b = spread.selfadjointView<Eigen::Lower>() * b;
  const double aa = a.dot(of_a), ab = a.dot(of_b), bb = b.dot(of_b);
  return 0.5 * (aa + bb - std::hypot(aa - bb, 2 * ab));
}
} // namespace

void
LocalMapOptions::validate() const
{
  require(std::isfinite(voxel) && voxel > 0, "voxel", voxel, "finite and > 0");
  require(levels >= 1 && levels <= kMostLevels, "levels", levels, "in [1, 8]");
  require(points_of_sweep >= 1, "points_of_sweep", points_of_sweep, ">= 1");
  require(points_of_voxel >= 1, "points_of_voxel", points_of_voxel, ">= 1");
}

LocalMap::LocalMap(const LocalMapOptions& options) : options_(options)
{
  options_.validate();
  levels_.resize(static_cast<std::size_t>(options_.levels));
  for (std::size_t l = 0; l < levels_.size(); ++l)
    levels_[l].edge = std::ldexp(options_.voxel, static_cast<int>(l));
}

bool
LocalMap::isInside(const Eigen::Vector3d& place) const
{
  return place.allFinite() &&
         place.cwiseAbs().maxCoeff() < kMostVoxels * options_.voxel;
}

/** \return the sums over the points of the sweep being added */
LocalMap::Sums&
LocalMap::freshSums(VoxelKey key, Level& level, std::vector<Fresh>& fresh)
{
  const auto [number, is_new] = level.numbers.add(key);
  if (is_new) {
    level.voxels.emplace_back().key = key;
    level.surfaces.emplace_back();
    level.fresh.push_back(0);
  }
  std::uint32_t& place = level.fresh[number];
  if (place == 0) {
    fresh.push_back({number, {}});
    place = static_cast<std::uint32_t>(fresh.size());
  }
  return fresh[place - 1].sums;
}

/** Adds sums about another point. \param[in] offset from the centre of `to` to the
 * centre of `from` */
void
LocalMap::shift(const Sums& from, const Eigen::Vector3d& offset, Sums& to)
{
  const Eigen::Vector3d &f = from.first, &o = offset;
  const double n = from.count;
  to.count += n;
  to.first += f + n * o;
  Eigen::Matrix<double, 6, 1> added;
  added << 2 * f.x() * o.x() + n * o.x() * o.x(),
      f.x() * o.y() + f.y() * o.x() + n * o.x() * o.y(),
      f.x() * o.z() + f.z() * o.x() + n * o.x() * o.z(),
      2 * f.y() * o.y() + n * o.y() * o.y(),
      f.y() * o.z() + f.z() * o.y() + n * o.y() * o.z(),
      2 * f.z() * o.z() + n * o.z() * o.z();
  to.second += from.second + added;
}

void
LocalMap::add(const std::vector<Eigen::Vector3d>& points,
              const std::optional<Eigen::Vector3d>& scanner)
{
  std::vector<Fresh> fresh, above;
  Level& finest = levels_.front();
  for (const Eigen::Vector3d& p : points) {
    if (!isInside(p))
      continue;
    const VoxelKey key = voxelKey(p.cast<float>(), finest.edge);
    const Eigen::Vector3d o = p - centreOf(key, finest.edge);
    shift({1, Eigen::Vector3d::Zero(), Eigen::Matrix<double, 6, 1>::Zero()},
          o,
          freshSums(key, finest, fresh));
  }
  for (std::size_t l = 0; l < levels_.size(); ++l, std::swap(fresh, above)) {
    Level& level = levels_[l];
    above.clear();
    for (const Fresh& sums : fresh) {
      if (l + 1 < levels_.size()) {
        Level& next = levels_[l + 1];
        const VoxelKey key = level.voxels[sums.number].key, around = coarserVoxel(key);
        shift(sums.sums,
              centreOf(key, level.edge) - centreOf(around, next.edge),
              freshSums(around, next, above));
      }
      level.fresh[sums.number] = 0;
      take(sums, scanner, level);
    }
  }
}

void
LocalMap::take(const Fresh& fresh,
               const std::optional<Eigen::Vector3d>& scanner,
               Level& level) const
{
  Voxel& voxel = level.voxels[fresh.number];
  Sums& sums = voxel.sums;
  const Sums& added = fresh.sums;
  const double weight = std::min(1.0, options_.points_of_sweep / added.count);
  const double room = options_.points_of_voxel - weight * added.count;
  const double kept = sums.count > 0 ? std::clamp(room / sums.count, 0.0, 1.0) : 1;
  sums.count = kept * sums.count + weight * added.count;
  sums.first = kept * sums.first + weight * added.first;
  sums.second = kept * sums.second + weight * added.second;
  const Eigen::Vector3d centre = centreOf(voxel.key, level.edge);
  if (scanner)
    sums.rays = kept * sums.rays +
                weight * added.count *
                    (centre + added.first / added.count - *scanner).stableNormalized();
  level.surfaces[fresh.number] = surfaceOf(sums, centre, level.edge);
}

MapSurface
LocalMap::surfaceOf(const Sums& sums, const Eigen::Vector3d& centre, double edge)
{
  MapSurface surface;
  if (sums.count < kLeastPoints)
    return surface;
  const Eigen::Vector3d mean = sums.first / sums.count;
  Eigen::Matrix3d spread; // the lower triangle is enough
  spread << sums.second(0), 0, 0, sums.second(1), sums.second(3), 0, sums.second(2),
      sums.second(4), sums.second(5);
  spread = spread / sums.count - mean * mean.transpose();
  const SymmetricEigen<3> axes = symmetricEigen<3>(spread);
  surface.mean = centre + mean;
  if (axes.values(1) < kLeastSpread * edge * kLeastSpread * edge)
    return surface;
  // Three parameters were fitted to the points.
  const double across = std::max(0.0, axes.values(0)) * sums.count / (sums.count - 3);
  const bool is_line =
      !sums.rays.isZero(0) && varianceAcrossRays(spread, sums.rays.stableNormalized()) <
                                  kSeenFlatness * kSeenFlatness * across;
  if (across * kFlatness * kFlatness <= axes.values(1) && !is_line) {
    surface.shape = VoxelShape::kPlane;
    surface.normal = axes.vectors.col(0);
    surface.variance = across;
  }
  else if (axes.values(0) >= kLeastSpread * edge * kLeastSpread * edge) {
    surface.shape = VoxelShape::kBlob;
    surface.variance = axes.values.mean();
  }
  return surface;
}

void
LocalMap::keepWithin(const Eigen::Vector3d& place, double distance)
{
  for (Level& level : levels_) {
    VoxelNumbers numbers;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < level.voxels.size(); ++i) {
      const VoxelKey key = level.voxels[i].key;
      if ((centreOf(key, level.edge) - place).norm() > distance)
        continue;
      numbers.add(key);
      level.voxels[kept] = level.voxels[i];
      level.surfaces[kept++] = level.surfaces[i];
    }
    level.voxels.resize(kept);
    level.surfaces.resize(kept);
    level.fresh.resize(kept);
    level.numbers = std::move(numbers);
  }
}

std::optional<VoxelKey>
LocalMap::voxelAt(const Eigen::Vector3d& place) const
{
  if (!isInside(place))
    return std::nullopt;
  return voxelKey(place.cast<float>(), options_.voxel);
}

const MapSurface*
LocalMap::surfaceAt(const Eigen::Vector3d& place) const
{
  const std::optional<VoxelKey> key = voxelAt(place);
  return key ? surfaceIn(*key) : nullptr;
}

const MapSurface*
LocalMap::surfaceIn(VoxelKey smallest) const
{
  const MapSurface* found = nullptr;
  VoxelKey key = smallest;
  for (const Level& level : levels_) {
    const std::size_t number = level.numbers.find(key);
    key = coarserVoxel(key);
    if (number == level.numbers.size())
      continue;
    const MapSurface& surface = level.surfaces[number];
    if (surface.shape == VoxelShape::kNone)
      continue;
    const bool is_plane = surface.shape == VoxelShape::kPlane;
    if (!found || (is_plane && (found->shape == VoxelShape::kBlob ||
                                surface.variance <= kSameVariance * found->variance)))
      found = &surface;
  }
  return found;
}

bool
LocalMap::isOccupied(const Eigen::Vector3d& place, int level) const
{
  if (!isInside(place))
    return false;
  const Level& looked_at = levels_.at(static_cast<std::size_t>(level));
  return looked_at.numbers.find(voxelKey(place.cast<float>(), looked_at.edge)) !=
         looked_at.numbers.size();
}

std::size_t
LocalMap::size() const
{
  std::size_t size = 0;
  for (const Level& level : levels_)
    size += level.voxels.size();
  return size;
}

std::size_t
LocalMap::numBytes() const
{
  std::size_t bytes = 0;
  for (const Level& level : levels_)
    bytes += level.voxels.capacity() * sizeof(Voxel) +
             level.surfaces.capacity() * sizeof(MapSurface) +
             level.fresh.capacity() * sizeof(std::uint32_t) +
             2 * level.voxels.capacity() * 2 * sizeof(VoxelKey); // hash half full
  return bytes;
}

} // namespace pcl6d
