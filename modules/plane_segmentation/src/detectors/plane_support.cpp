// SPDX-License-Identifier: BSD-3-Clause
#include "detectors/plane_support.h"
#include "planes/plane_moments.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/simd_clones.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl6d::plane_segmentation {

namespace {
constexpr int kMaxFits = 5;
/** A patch that grows by less than this share is final. */
constexpr double kGrowth = 0.02;
/** A patch is curved if a quadric explains kCurved of the squared distances to its
 * plane, and their rms is at least kFilled of their reach (1 / sqrt(3) if they fill the
 * slab evenly): less is rounding. */
constexpr double kCurved = 0.85, kFilled = 0.01;

/** Writes 1 for each surfel in the slab, else 0. \return how many are */
PCL6D_SIMD_CLONES std::int32_t
classify(const SurfelColumns& surfels, const Slab& slab, std::int32_t* inside)
{
  const float *x = surfels.x.data(), *y = surfels.y.data(), *z = surfels.z.data();
  const float *nx = surfels.nx.data(), *ny = surfels.ny.data(), *nz = surfels.nz.data();
  const float* reach = surfels.reach.data();
  const float a = slab.normal.x(), b = slab.normal.y(), c = slab.normal.z();
  const float offset = slab.offset, slack = slab.slack, cosine = slab.min_cosine;
  std::int32_t sum = 0;
  for (std::size_t i = 0; i < surfels.size(); ++i) {
    const float distance = std::abs(a * x[i] + b * y[i] + c * z[i] - offset);
    const float facing = a * nx[i] + b * ny[i] + c * nz[i];
    inside[i] = static_cast<std::int32_t>(distance <= reach[i] + slack) &
                static_cast<std::int32_t>(facing >= cosine);
    sum += inside[i];
  }
  return sum;
}

/** \return the largest connected patch in a slab, ascending; of equals the first */
std::vector<std::uint32_t>
largestPatch(const RemainingSurfels& surfels, const Slab& slab)
{
  std::vector<std::int32_t> inside(surfels.size());
  classify(surfels.columns(), slab, inside.data());
  std::vector<std::uint32_t> largest, patch;
  for (std::uint32_t first = 0; first < inside.size(); ++first) {
    if (!inside[first])
      continue;
    patch.assign(1, first);
    inside[first] = 0;
    for (std::size_t next = 0; next < patch.size(); ++next)
      surfels.visitNeighbours(patch[next], [&](std::uint32_t slot) {
        if (inside[slot]) {
          inside[slot] = 0;
          patch.push_back(slot);
        }
      });
    if (patch.size() > largest.size())
      largest.swap(patch);
  }
  std::sort(largest.begin(), largest.end());
  return largest;
}

/** \return the least-squares plane, oriented like `before`; `before` itself for
 * collinear surfels */
Slab
fitted(const SurfelColumns& surfels,
       const std::vector<std::uint32_t>& slots,
       const Slab& before)
{
  PlaneMoments sums(surfels.point(slots.front()).cast<double>());
  for (const auto slot : slots) {
    const double reach = surfels.reach[slot];
    sums.add(surfels.point(slot).cast<double>(), 1 / (reach * reach));
  }
  auto plane = sums.fit();
  Slab slab = before;
  slab.slack = 0;
  if (!plane)
    return slab;
  if (plane->normal.dot(before.normal.cast<double>()) < 0)
    plane->flip();
  slab.normal = plane->normal.cast<float>();
  slab.offset = static_cast<float>(plane->offset);
  return slab;
}
} // namespace

std::size_t
countInside(const SurfelColumns& surfels, const Slab& slab)
{
  thread_local std::vector<std::int32_t> inside;
  inside.resize(surfels.size());
  return static_cast<std::size_t>(classify(surfels, slab, inside.data()));
}

Support
findSupport(const RemainingSurfels& surfels, Slab slab)
{
  Support best{slab, {}};
  for (int fit = 0; fit < kMaxFits; ++fit) {
    auto patch = largestPatch(surfels, slab);
    const auto before = static_cast<double>(best.slots.size());
    const auto after = static_cast<double>(patch.size());
    if (patch.size() < 3)
      break;
    if (after > before || fit == 1)
      best = {slab, std::move(patch)};
    if (fit > 0 && after <= (1 + kGrowth) * before)
      break;
    slab = fitted(surfels.columns(), best.slots, slab);
  }
  return best;
}

bool
isCurved(const SurfelColumns& surfels, const Support& support)
{
  using Row = Eigen::Matrix<double, 6, 1>;
  const Eigen::Vector3d normal = support.slab.normal.cast<double>();
  const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  const Eigen::Vector3d near = surfels.point(support.slots.front()).cast<double>();
  Eigen::Matrix<double, 6, 6> squares = Eigen::Matrix<double, 6, 6>::Zero();
  Row products = Row::Zero();
  double sum = 0, reach = 0;
  for (const auto slot : support.slots) {
    const Eigen::Vector3d p = surfels.point(slot).cast<double>() - near;
    const double s = u.dot(p), t = v.dot(p);
    const double height = normal.dot(p + near) - support.slab.offset;
    const Row row = (Row() << 1, s, t, s * s, s * t, t * t).finished();
    squares += row * row.transpose();
    products += height * row;
    sum += height * height;
    reach += static_cast<double>(surfels.reach[slot]) * surfels.reach[slot];
  }
  const double explained = products.dot(solveSymmetric(squares, products));
  return sum > kFilled * kFilled * reach && explained > kCurved * sum;
}

Support
PlaneSearch::supportOf(const Slab& guess) const
{
  Support support = findSupport(surfels_, guess);
  if (support.slots.size() < min_surfels_)
    support.slots.clear();
  return support;
}

bool
PlaneSearch::take(const Support& support)
{
  const bool flat = !isCurved(surfels_.columns(), support);
  if (flat)
    found_.push_back(surfels_.pointsOf(support.slots));
  surfels_.remove(support.slots);
  return flat;
}

} // namespace pcl6d::plane_segmentation
