// SPDX-License-Identifier: BSD-3-Clause
#include "detectors/consensus_kernels.h"

#include <pcl6d/common/simd_clones.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pcl6d::plane_segmentation {

namespace {
constexpr std::size_t kLanes = 4; // parallel partial sums on any CPU, for equal bits
using DoubleLanes = double __attribute__((vector_size(8 * kLanes)));
using FloatLanes = float __attribute__((vector_size(4 * kLanes)));

/** \return the arc cosine [rad] of x in [0, 1], within 4e-7: M. Abramowitz, I. A.
 * Stegun, "Handbook of Mathematical Functions", 1964, 4.4.46, in float */
PCL6D_INLINE float
acuteAngle(float x)
{
  float sum = -0.0012624911f;
  sum = sum * x + 0.0066700901f;
  sum = sum * x - 0.0170881256f;
  sum = sum * x + 0.0308918810f;
  sum = sum * x - 0.0501743046f;
  sum = sum * x + 0.0889789874f;
  sum = sum * x - 0.2145988016f;
  sum = sum * x + 1.5707963050f;
  return std::sqrt(std::max(0.0f, 1 - x)) * sum;
}

PCL6D_SIMD_CLONES void
plainDistances(const float* x,
               const float* y,
               const float* z,
               std::size_t size,
               const LocalPlane& plane,
               float* distances)
{
  const float a = plane.normal.x(), b = plane.normal.y(), c = plane.normal.z();
  const float offset = plane.offset;
  for (std::size_t i = 0; i < size; ++i)
    distances[i] = std::abs(a * x[i] + b * y[i] + c * z[i] - offset);
}

/** Mixes the angles of normals into distances. */
PCL6D_SIMD_CLONES void
mixInAngles(const ConsensusPoints& points,
            std::size_t begin,
            std::size_t size,
            const LocalPlane& plane,
            float* distances)
{
  const float* x = points.normal(0) + begin;
  const float* y = points.normal(1) + begin;
  const float* z = points.normal(2) + begin;
  const float* weight = points.weight() + begin;
  const float a = plane.normal.x(), b = plane.normal.y(), c = plane.normal.z();
  for (std::size_t i = 0; i < size; ++i) {
    const float cosine = std::min(1.0f, std::abs(a * x[i] + b * y[i] + c * z[i]));
    distances[i] = (1 - weight[i]) * distances[i] + weight[i] * acuteAngle(cosine);
  }
}

PCL6D_SIMD_CLONES std::int32_t
countClones(const float* distances, std::size_t size, float limit)
{
  std::int32_t count = 0;
  for (std::size_t i = 0; i < size; ++i)
    count += static_cast<std::int32_t>(distances[i] < limit);
  return count;
}

/** The sums of PlaneMoments, lane by lane. */
struct MomentLanes {
  DoubleLanes count{}, x{}, y{}, z{}, xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
};

PCL6D_INLINE void
widen(const float* values, DoubleLanes& wide)
{
  FloatLanes lanes;
  std::memcpy(&lanes, values, sizeof lanes);
  wide = __builtin_convertvector(lanes, DoubleLanes);
}

PCL6D_INLINE void
addLanes(MomentLanes& sums,
         const float* px,
         const float* py,
         const float* pz,
         const float* distances,
         double limit)
{
  DoubleLanes x, y, z, d;
  widen(px, x);
  widen(py, y);
  widen(pz, z);
  widen(distances, d);
  const DoubleLanes in = d < DoubleLanes{} + limit ? DoubleLanes{} + 1 : DoubleLanes{};
  const DoubleLanes wx = in * x, wy = in * y, wz = in * z;
  sums.count += in;
  sums.x += wx;
  sums.y += wy;
  sums.z += wz;
  sums.xx += wx * x;
  sums.xy += wx * y;
  sums.xz += wx * z;
  sums.yy += wy * y;
  sums.yz += wy * z;
  sums.zz += wz * z;
}

PCL6D_SIMD_CLONES void
sumMoments(const float* x,
           const float* y,
           const float* z,
           const float* distances,
           std::size_t size,
           float limit,
           MomentLanes& result)
{
  MomentLanes sums;
  const std::size_t whole = size - size % kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes)
    addLanes(sums, x + i, y + i, z + i, distances + i, limit);
  if (whole < size) {
    float rest[4][kLanes] = {};
    std::fill(rest[3], rest[3] + kLanes, limit); // not below it
    for (std::size_t i = whole; i < size; ++i) {
      rest[0][i - whole] = x[i];
      rest[1][i - whole] = y[i];
      rest[2][i - whole] = z[i];
      rest[3][i - whole] = distances[i];
    }
    addLanes(sums, rest[0], rest[1], rest[2], rest[3], limit);
  }
  result = sums;
}

double
sumOf(const DoubleLanes& lanes)
{
  return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}
} // namespace

void
consensusDistances(const ConsensusPoints& points,
                   std::size_t begin,
                   std::size_t size,
                   const LocalPlane& plane,
                   float* distances)
{
  plainDistances(points.x() + begin,
                 points.y() + begin,
                 points.z() + begin,
                 size,
                 plane,
                 distances);
  if (points.hasNormals())
    mixInAngles(points, begin, size, plane, distances);
}

std::size_t
countBelow(const float* distances, std::size_t size, float limit)
{
  return static_cast<std::size_t>(countClones(distances, size, limit));
}

double
gainBelow(const float* distances, std::size_t size, float limit)
{
  const double per_square = 1 / (static_cast<double>(limit) * limit);
  double gain = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const double d = distances[i];
    gain += distances[i] < limit ? 1 - d * d * per_square : 0.0;
  }
  return gain;
}

std::size_t
placesBelow(const ConsensusPoints& points,
            std::size_t begin,
            std::size_t size,
            const float* distances,
            float limit,
            std::uint32_t* places)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < size; ++i) {
    places[count] = points.place(begin + i);
    count += static_cast<std::size_t>(distances[i] < limit);
  }
  return count;
}

PlaneMoments
momentsBelow(const ConsensusPoints& points,
             std::size_t begin,
             std::size_t size,
             const float* distances,
             float limit)
{
  MomentLanes lanes;
  sumMoments(points.x() + begin,
             points.y() + begin,
             points.z() + begin,
             distances,
             size,
             limit,
             lanes);
  Eigen::Matrix3d squares;
  squares << sumOf(lanes.xx), sumOf(lanes.xy), sumOf(lanes.xz), sumOf(lanes.xy),
      sumOf(lanes.yy), sumOf(lanes.yz), sumOf(lanes.xz), sumOf(lanes.yz),
      sumOf(lanes.zz);
  return PlaneMoments(static_cast<std::size_t>(sumOf(lanes.count)),
                      {sumOf(lanes.x), sumOf(lanes.y), sumOf(lanes.z)},
                      squares);
}

} // namespace pcl6d::plane_segmentation
