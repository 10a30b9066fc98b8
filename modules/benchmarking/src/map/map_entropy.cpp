// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/benchmarking/map_entropy.h>
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/points.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/simd_clones.h>
#include <pcl6d/common/voxel_key.h>
#include <pcl6d/filters/voxel_reduction.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace pcl6d {
namespace {
/** \brief Moments of the points around a position, relative to the position. */
struct PointMoments {
  std::size_t count = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero(); ///< sum of p p^T

  /** \return the covariance with divisor count; count > 0 */
  Eigen::Matrix3d
  covariance() const;
};

/** \brief Points sorted into cells of edge length radius: the neighbours of a position lie in
 * 27 cells. Sums need no list of neighbours, of which a map has thousands per position. */
class PointGrid {
public:
  /** \param[in] points [m] points that are not finite are left out
   * \throws BadArgument a point does not fit into the grid (voxelKey()) */
  PointGrid(const Points& points, double radius);

  /** \return the sums over the points within the radius of a finite position */
  PointMoments
  momentsAround(const Eigen::Vector3f& place) const;

private:
  double radius_;
  std::vector<VoxelKey> keys_;            ///< of the occupied cells, ascending
  std::vector<std::size_t> begin_;        ///< first point of each cell, and the end
  std::array<std::vector<float>, 3> xyz_; ///< of the points, cell by cell
};

/** Several sums side by side, point i in lane i modulo kLanes: a vector register holds
 * eight lanes, and the order of the additions does not depend on the CPU. */
constexpr std::size_t kLanes = 8;
constexpr std::size_t kSums = 10; // count, x y z, xx xy xz yy yz zz

struct LaneSums {
  float of[kSums][kLanes] = {};
};

/** A run of points; at most kRun, to preserve the digits of float. */
struct Run {
  const float* x;
  const float* y;
  const float* z;
  std::size_t count;
};
constexpr std::size_t kRun = 4096;

PCL6D_INLINE void
addPoint(const Run& run,
         std::size_t i,
         std::size_t lane,
         const float* place,
         float radius_sq,
         LaneSums& sums)
{
  const float dx = run.x[i] - place[0], dy = run.y[i] - place[1],
              dz = run.z[i] - place[2];
  const bool near = dx * dx + dy * dy + dz * dz <= radius_sq;
  const float u = near ? dx : 0, v = near ? dy : 0, w = near ? dz : 0;
  sums.of[0][lane] += near ? 1.0f : 0.0f;
  sums.of[1][lane] += u;
  sums.of[2][lane] += v;
  sums.of[3][lane] += w;
  sums.of[4][lane] += u * u;
  sums.of[5][lane] += u * v;
  sums.of[6][lane] += u * w;
  sums.of[7][lane] += v * v;
  sums.of[8][lane] += v * w;
  sums.of[9][lane] += w * w;
}

PCL6D_SIMD_CLONES void
addRun(const Run& run, const float* place, float radius_sq, LaneSums& result)
{
  LaneSums sums;
  std::size_t i = 0;
  for (; i + kLanes <= run.count; i += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      addPoint(run, i + lane, lane, place, radius_sq, sums);
  for (std::size_t lane = 0; i + lane < run.count; ++lane)
    addPoint(run, i + lane, lane, place, radius_sq, sums);
  result = sums;
}

double
total(const float (&lanes)[kLanes])
{
  double sum = 0;
  for (const float lane : lanes)
    sum += lane;
  return sum;
}

void
addTo(PointMoments& moments, const LaneSums& sums)
{
  moments.count += static_cast<std::size_t>(total(sums.of[0]));
  for (int axis = 0; axis < 3; ++axis)
    moments.sum[axis] += total(sums.of[1 + axis]);
  int k = 4;
  for (int row = 0; row < 3; ++row)
    for (int col = row; col < 3; ++col, ++k)
      moments.squares(row, col) += total(sums.of[k]);
}

Eigen::Matrix3d
PointMoments::covariance() const
{
  const Eigen::Vector3d mean = sum / static_cast<double>(count);
  const Eigen::Matrix3d second = squares.selfadjointView<Eigen::Upper>();
  return second / static_cast<double>(count) - mean * mean.transpose();
}

PointGrid::PointGrid(const Points& points, double radius) : radius_(radius)
{
  const VoxelGroups groups(points, radius);
  for (std::size_t group = 0; group < groups.size(); ++group) {
    keys_.push_back(groups.key(group));
    begin_.push_back(xyz_[0].size());
    for (const auto index : groups.indices(group))
      for (int axis = 0; axis < 3; ++axis)
        xyz_[axis].push_back(points[static_cast<std::size_t>(index)][axis]);
  }
  begin_.push_back(xyz_[0].size());
}

PointMoments
PointGrid::momentsAround(const Eigen::Vector3f& place) const
{
  const auto radius_sq = static_cast<float>(radius_ * radius_);
  PointMoments moments;
  const auto addCell = [&](std::size_t cell) {
    for (std::size_t i = begin_[cell]; i < begin_[cell + 1]; i += kRun) {
      LaneSums sums;
      addRun({xyz_[0].data() + i,
              xyz_[1].data() + i,
              xyz_[2].data() + i,
              std::min(kRun, begin_[cell + 1] - i)},
             place.data(),
             radius_sq,
             sums);
      addTo(moments, sums);
    }
  };
  // A key has 21 bits for each axis, x in front. At the edge of the grid a step wraps
  // to a distant cell, whose points are not within the radius.
  const VoxelKey middle = voxelKey(place, radius_), y = VoxelKey{1} << 21, x = y << 21;
  for (const VoxelKey column : {middle - x, middle, middle + x})
    for (const VoxelKey row : {column - y, column, column + y}) {
      auto cell = std::lower_bound(keys_.begin(), keys_.end(), row - 1);
      for (; cell != keys_.end() && *cell <= row + 1; ++cell)
        addCell(static_cast<std::size_t>(cell - keys_.begin()));
    }
  return moments;
}

constexpr std::size_t kBlockSize = 64;            // places
constexpr double kLeastVariance = 1e-8;           // [m^2] of points on an exact plane
constexpr double kLogTwoPi = 1.83787706640934548; // ln(2 pi)

LocalSpread
spreadOf(const PointMoments& moments, std::size_t min_points)
{
  LocalSpread spread;
  spread.points = moments.count;
  spread.entropy = spread.variance = std::numeric_limits<double>::quiet_NaN();
  if (moments.count < min_points)
    return spread;
  const Eigen::Vector3d values =
      symmetricEigenvalues<3>(moments.covariance()).cwiseMax(kLeastVariance);
  spread.variance = values[0];
  spread.entropy = 1.5 * (kLogTwoPi + 1) + 0.5 * portableLog(values.prod());
  return spread;
}
} // namespace

void
MapEntropyOptions::validate() const
{
  require(std::isfinite(radius) && radius > 0, "radius", radius, "finite and > 0");
  require(min_points >= 4, "min_points", min_points, ">= 4");
}

std::vector<LocalSpread>
localSpreads(const Points& places, const Points& map, const MapEntropyOptions& options)
{
  options.validate();
  const PointGrid grid(map, options.radius);
  std::vector<LocalSpread> spreads(places.size());
  parallelBlocks(
      places.size(), kBlockSize, options.num_threads, [&](const Block& block) {
        for (std::size_t i = block.begin; i < block.end; ++i)
          spreads[i] = spreadOf(places[i].allFinite() ? grid.momentsAround(places[i])
                                                      : PointMoments(),
                                options.min_points);
      });
  return spreads;
}

} // namespace pcl6d
