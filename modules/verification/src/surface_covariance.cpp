// SPDX-License-Identifier: BSD-3-Clause
#include "surface_covariance.h"

#include <pcl6d/common/voxel_numbers.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
/** Shifts of the grids, in cubes. */
constexpr double kGridShifts[][3] = {{0, 0, 0},
                                     {0.5, 0.5, 0},
                                     {0.5, 0, 0.5},
                                     {0, 0.5, 0.5}};

} // namespace

Twist
verification::jacobianOf(const Eigen::Vector3d& place,
                         const Eigen::Vector3d& normal,
                         const Eigen::Vector3d& centroid)
{
  Twist j;
  j.head<3>() = normal;
  j.tail<3>() = (place - centroid).cross(normal);
  return j;
}

verification::PairGrids
verification::gridsOf(const std::vector<SurfacePair>& pairs,
                      const Eigen::Vector3d& centroid,
                      double cube)
{
  PairGrids grids;
  for (std::size_t k = 0; k < grids.size(); ++k) {
    const auto& shift = kGridShifts[k];
    const Eigen::Vector3d offset = cube * Eigen::Vector3d(shift[0], shift[1], shift[2]);
    VoxelNumbers cubes;
    grids[k].of_pair.reserve(pairs.size());
    for (const SurfacePair& pair : pairs) {
      const Eigen::Vector3d place = pair.place - centroid + offset;
      const auto [number, is_new] = cubes.add(voxelKey(place.cast<float>(), cube));
      grids[k].count += is_new ? 1 : 0;
      grids[k].of_pair.push_back(number);
    }
  }
  return grids;
}

verification::Matrix6
verification::sumOfCubes(const std::vector<Twist>& terms,
                         const PairGrids& grids,
                         int unknowns)
{
  Matrix6 all = Matrix6::Zero();
  for (const PairCubes& cubes : grids) {
    std::vector<Twist> sums(cubes.count, Twist::Zero());
    for (std::size_t i = 0; i < terms.size(); ++i)
      sums[cubes.of_pair[i]] += terms[i];
    Matrix6 sum = Matrix6::Zero();
    for (const Twist& of_cube : sums)
      sum += of_cube * of_cube.transpose();
    const auto count = static_cast<double>(cubes.count);
    sum *= count / std::max(count - unknowns, 1.0);
    all += sum / static_cast<double>(grids.size());
  }
  return all;
}

double
verification::MeasuredTwice::weight(int direction, double mean_square) const
{
  return std::min(std::max(product(direction), deviation(direction)), mean_square);
}

verification::MeasuredTwice
verification::measuredTwice(const std::vector<SurfacePair>& pairs,
                            const Eigen::Vector3d& centroid,
                            const Matrix6& axes,
                            const PairGrids& grids)
{
  MeasuredTwice twice;
  const auto count = static_cast<double>(pairs.size());
  std::vector<Twist> products;
  products.reserve(pairs.size());
  for (const SurfacePair& pair : pairs) {
    twice.one.push_back(axes.transpose() *
                        jacobianOf(pair.place, pair.normal, centroid));
    twice.other.push_back(axes.transpose() *
                          jacobianOf(pair.place, pair.other_normal, centroid));
    products.push_back(twice.one.back().cwiseProduct(twice.other.back()));
    twice.product += products.back() / count;
  }
  twice.deviation = sumOfCubes(products, grids, 0).diagonal().cwiseSqrt() / count;
  return twice;
}

verification::Matrix6
verification::gradientCovariance(const std::vector<Twist>& gradients,
                                 const PairGrids& narrow,
                                 const PairGrids& wide,
                                 const Twist& least)
{
  Matrix6 floor = Matrix6::Zero();
  floor.diagonal() = least;
  const Matrix6 of_narrow = floor + sumOfCubes(gradients, narrow, 6);
  const Matrix6 of_wide = floor + sumOfCubes(gradients, wide, 6);
  double ratios = 0, directions = 0; // of variances
  for (int k = 0; k < 6; ++k)
    if (of_narrow(k, k) > 0) {
      ratios += of_wide(k, k) / of_narrow(k, k);
      ++directions;
    }
  return ratios > directions ? of_wide : of_narrow;
}

} // namespace pcl6d
