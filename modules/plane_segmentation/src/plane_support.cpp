// SPDX-License-Identifier: BSD-3-Clause
#include "plane_support.h"

#include <pcl6d/common/components.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define PCL6D_SIMD_CLONES __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define PCL6D_SIMD_CLONES
#endif

namespace pcl6d {

namespace {
constexpr int kMaxFits = 5;
/** A patch that grows by less than this share is fitted well enough. */
constexpr double kGrowth = 0.02;
constexpr double kMaxCells = 1 << 22;
/** A patch is curved if a quadric explains so much of the squared distances to its plane
 * and their rms is so much of the slab's reach: 1 / sqrt(3) if they fill it evenly. */
constexpr double kCurved = 0.7, kFilled = 0.3;
constexpr double kLineTolerance = 1e-9; // of the squared spreads

// How near the points are to the plane and how they face: 1 both, 2 only near, 0 far.
PCL6D_SIMD_CLONES void
classify(const float* x,
         const float* y,
         const float* z,
         const float* nx,
         const float* ny,
         const float* nz,
         std::size_t size,
         const Slab& slab,
         std::int32_t* inside)
{
  const float a = slab.normal.x(), b = slab.normal.y(), c = slab.normal.z();
  const float offset = slab.offset, reach = slab.max_distance, cosine = slab.min_cosine;
  for (std::size_t i = 0; i < size; ++i) {
    const float distance = std::abs(a * x[i] + b * y[i] + c * z[i] - offset);
    const float facing = a * nx[i] + b * ny[i] + c * nz[i];
    inside[i] = static_cast<std::int32_t>(distance <= reach) &
                static_cast<std::int32_t>(facing >= cosine);
  }
}

PCL6D_SIMD_CLONES std::int32_t
count(const float* x,
      const float* y,
      const float* z,
      const float* nx,
      const float* ny,
      const float* nz,
      std::size_t size,
      const Slab& slab)
{
  const float a = slab.normal.x(), b = slab.normal.y(), c = slab.normal.z();
  const float offset = slab.offset, reach = slab.max_distance, cosine = slab.min_cosine;
  std::int32_t sum = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const float distance = std::abs(a * x[i] + b * y[i] + c * z[i] - offset);
    const float facing = a * nx[i] + b * ny[i] + c * nz[i];
    sum += static_cast<std::int32_t>(distance <= reach) &
           static_cast<std::int32_t>(facing >= cosine);
  }
  return sum;
}

std::vector<std::uint32_t>
slotsInside(const PointColumns& points, const Slab& slab)
{
  std::vector<std::int32_t> inside(points.size());
  classify(points.x.data(),
           points.y.data(),
           points.z.data(),
           points.nx.data(),
           points.ny.data(),
           points.nz.data(),
           points.size(),
           slab,
           inside.data());
  std::vector<std::uint32_t> slots;
  for (std::size_t i = 0; i < inside.size(); ++i)
    if (inside[i])
      slots.push_back(static_cast<std::uint32_t>(i));
  return slots;
}

/** A grid on a plane, and the cell of each of some points. */
struct PlaneGrid {
  std::size_t columns = 0, rows = 0;
  std::vector<std::size_t> cells;
};

PlaneGrid
makeGrid(const PointColumns& points,
         const std::vector<std::uint32_t>& slots,
         const Eigen::Vector3f& normal,
         double edge)
{
  const Eigen::Vector3f u = normal.unitOrthogonal();
  const Eigen::Vector3f v = normal.cross(u);
  std::vector<Eigen::Vector2f> flat;
  flat.reserve(slots.size());
  Eigen::AlignedBox2f box;
  for (const auto slot : slots) {
    flat.emplace_back(u.dot(points.point(slot)), v.dot(points.point(slot)));
    box.extend(flat.back());
  }
  const Eigen::Vector2d size = box.sizes().cast<double>();
  while ((size.x() / edge + 1) * (size.y() / edge + 1) > kMaxCells)
    edge *= 2;
  PlaneGrid grid;
  grid.columns = static_cast<std::size_t>(size.x() / edge) + 2;
  grid.rows = static_cast<std::size_t>(size.y() / edge) + 2;
  grid.cells.reserve(slots.size());
  for (const auto& p : flat) {
    const Eigen::Vector2f cell = (p - box.min()) / static_cast<float>(edge);
    grid.cells.push_back(static_cast<std::size_t>(cell.y()) * grid.columns +
                         static_cast<std::size_t>(cell.x()));
  }
  return grid;
}

/** Joins the cells with points that touch, at corners too. */
Components
connectCells(const PlaneGrid& grid, const std::vector<std::uint32_t>& counts)
{
  Components patches(counts.size());
  for (std::size_t row = 0; row < grid.rows; ++row)
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const std::size_t cell = row * grid.columns + column;
      if (counts[cell] == 0)
        continue;
      if (column > 0 && counts[cell - 1])
        patches.join(cell, cell - 1);
      for (std::size_t below = column > 0 ? cell - 1 : cell;
           row > 0 && below <= cell + 1 && below - (cell - column) < grid.columns;
           ++below)
        if (counts[below - grid.columns])
          patches.join(cell, below - grid.columns);
    }
  return patches;
}

/** Keeps the largest connected patch; of equals that of the first cell. */
std::vector<std::uint32_t>
largestPatch(const PointColumns& points,
             const std::vector<std::uint32_t>& slots,
             const Eigen::Vector3f& normal,
             double edge)
{
  const PlaneGrid grid = makeGrid(points, slots, normal, edge);
  std::vector<std::uint32_t> counts(grid.columns * grid.rows, 0);
  for (const auto cell : grid.cells)
    ++counts[cell];
  const std::vector<std::size_t> firsts = connectCells(grid, counts).firsts();
  std::vector<std::uint32_t> sizes(counts.size(), 0);
  for (std::size_t cell = 0; cell < counts.size(); ++cell)
    sizes[firsts[cell]] += counts[cell];
  const auto largest = static_cast<std::size_t>(
      std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  std::vector<std::uint32_t> patch;
  for (std::size_t i = 0; i < slots.size(); ++i)
    if (firsts[grid.cells[i]] == largest)
      patch.push_back(slots[i]);
  return patch;
}

Eigen::Vector3d
meanOf(const PointColumns& points, const std::vector<std::uint32_t>& slots)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto slot : slots)
    sum += points.point(slot).cast<double>();
  return sum / static_cast<double>(slots.size());
}

/** \return the plane of least squares through some points, turned as the one before;
 * unchanged for points on a line */
Slab
fitted(const PointColumns& points, const std::vector<std::uint32_t>& slots, Slab slab)
{
  const Eigen::Vector3d mean = meanOf(points, slots);
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const auto slot : slots) {
    const Eigen::Vector3d d = points.point(slot).cast<double>() - mean;
    scatter += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  if (!(solver.eigenvalues()(1) > kLineTolerance * solver.eigenvalues()(2)))
    return slab;
  Eigen::Vector3d normal = solver.eigenvectors().col(0);
  if (normal.dot(slab.normal.cast<double>()) < 0)
    normal = -normal;
  slab.normal = normal.cast<float>();
  slab.offset = static_cast<float>(normal.dot(mean));
  return slab;
}
} // namespace

std::size_t
countInside(const PointColumns& points, const Slab& slab)
{
  return static_cast<std::size_t>(count(points.x.data(),
                                        points.y.data(),
                                        points.z.data(),
                                        points.nx.data(),
                                        points.ny.data(),
                                        points.nz.data(),
                                        points.size(),
                                        slab));
}

Support
findSupport(const RemainingPoints& points, Slab slab, const SupportOptions& options)
{
  const PointColumns& columns = points.columns();
  Support best{slab, {}};
  for (int fit = 0; fit < kMaxFits; ++fit) {
    const auto near = slotsInside(columns, slab);
    if (near.size() < 3)
      break;
    auto patch = largestPatch(columns, near, slab.normal, options.gap);
    const auto before = static_cast<double>(best.slots.size());
    const auto after = static_cast<double>(patch.size());
    if (after > before)
      best = {slab, std::move(patch)};
    if (after <= (1 + kGrowth) * before)
      break;
    slab = fitted(columns, best.slots, slab);
    slab.max_distance = static_cast<float>(options.max_distance);
  }
  return best;
}

bool
isCurved(const PointColumns& points, const Support& support)
{
  using Row = Eigen::Matrix<double, 6, 1>;
  const Eigen::Vector3d normal = support.slab.normal.cast<double>();
  const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  const Eigen::Vector3d middle = meanOf(points, support.slots);
  Eigen::Matrix<double, 6, 6> squares = Eigen::Matrix<double, 6, 6>::Zero();
  Row products = Row::Zero();
  double sum = 0;
  for (const auto slot : support.slots) {
    const Eigen::Vector3d p = points.point(slot).cast<double>() - middle;
    const double s = u.dot(p), t = v.dot(p), height = normal.dot(p);
    const Row row = (Row() << 1, s, t, s * s, s * t, t * t).finished();
    squares += row * row.transpose();
    products += height * row;
    sum += height * height;
  }
  const double explained = products.dot(squares.ldlt().solve(products));
  const double thickness = kFilled * support.slab.max_distance;
  return sum > thickness * thickness * static_cast<double>(support.slots.size()) &&
         explained > kCurved * sum;
}

} // namespace pcl6d
