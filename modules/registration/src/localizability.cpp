// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/registration/localizability.h>

#include <Eigen/Eigenvalues>

#include <cmath>

namespace pcl6d {

int
Localizability::openDirections(double threshold) const
{
  return static_cast<int>((eigenvalues.array() < threshold).count());
}

Localizability
localizabilityOf(const PlaneSums& sums)
{
  Localizability found;
  if (sums.count == 0 || !sums.A.allFinite())
    return found;
  found.centroid = sums.mean_source;
  const double spread_sq = sums.source_sq / sums.weight;
  found.scale = spread_sq > 0 ? std::sqrt(spread_sq) : 1;
  Twist unit = Twist::Ones();
  unit.tail<3>().setConstant(1 / found.scale);
  const PlaneSums::Matrix scaled =
      unit.asDiagonal() * sums.A * unit.asDiagonal() / sums.weight;
  const Eigen::SelfAdjointEigenSolver<PlaneSums::Matrix> solver(scaled);
  found.eigenvalues = solver.eigenvalues().cwiseMax(0);
  found.directions = solver.eigenvectors();
  return found;
}

} // namespace pcl6d
