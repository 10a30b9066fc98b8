// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/simd_clones.h>
#include <pcl6d/registration/plane_sums.h>

#include <algorithm>
#include <cstring>

namespace pcl6d {

namespace {
/** planeToPlane() by its upper half, xx, xy, xz, yy, yz, zz. */
void
planesNorm(const Eigen::Vector3d& n,
           const Eigen::Vector3d& m,
           double epsilon,
           double* N)
{
  // In the orthogonal directions n + m and n - m, the sum of the covariances 2 I - k (n n^T + m
  // m^T), k = 1 - epsilon, has the values 2 - k (1 +- c); 2 elsewhere.
  const double k = 1 - epsilon, c = n.dot(m);
  const double of_sum = 2 - k * (1 + c), of_difference = 2 - k * (1 - c);
  const double common = epsilon * k / (2 * of_sum * of_difference);
  const double along_sum = common * of_difference, along_difference = common * of_sum;
  const double s[] = {n.x() + m.x(), n.y() + m.y(), n.z() + m.z()};
  const double d[] = {n.x() - m.x(), n.y() - m.y(), n.z() - m.z()};
  for (int row = 0; row < 3; ++row)
    for (int column = row; column < 3; ++column)
      *N++ = (row == column ? epsilon : 0) + along_sum * s[row] * s[column] +
             along_difference * d[row] * d[column];
}

/** Moves the origin of the twist by an offset: a becomes (n, a_x - offset x n). */
void
moveOrigin(PlaneSums& sums, const Eigen::Vector3d& offset)
{
  PlaneSums::Matrix L = PlaneSums::Matrix::Identity();
  L.bottomLeftCorner<3, 3>() = -skew(offset);
  sums.A = (L * sums.A * L.transpose()).eval();
  sums.b = (L * sums.b).eval();
}
} // namespace

Eigen::Matrix3d
planeToPlane(const Eigen::Vector3d& n, const Eigen::Vector3d& m, double epsilon)
{
  double N[6];
  planesNorm(n, m, epsilon, N);
  Eigen::Matrix3d norm;
  norm << N[0], N[1], N[2], N[1], N[3], N[4], N[2], N[4], N[5];
  return norm;
}

PlaneSums
PlaneSums::merge(const PlaneSums& a, const PlaneSums& b)
{
  if (a.count == 0)
    return b;
  if (b.count == 0)
    return a;
  const Eigen::Vector3d distance = b.mean_source - a.mean_source;
  const double share = b.weight / (a.weight + b.weight);
  PlaneSums sum = a, other = b;
  moveOrigin(sum, share * distance);
  moveOrigin(other, (share - 1) * distance);
  sum.count += b.count;
  sum.weight += b.weight;
  sum.mean_source += share * distance;
  sum.A += other.A;
  sum.b += other.b;
  sum.residual_sq += b.residual_sq;
  sum.distance_sq += b.distance_sq;
  sum.scatter += b.scatter + a.weight * share * distance * distance.transpose();
  return sum;
}

namespace {
/** Eight pairs, a pair in each lane. */
using Lanes = double __attribute__((vector_size(64)));

PCL6D_INLINE void
load(Lanes& lanes, const double* values)
{
  std::memcpy(&lanes, values, sizeof(lanes));
}

PCL6D_INLINE void
addTo(double*& sum, const Lanes& values)
{
  Lanes next;
  load(next, sum);
  next += values;
  std::memcpy(sum, &next, sizeof(next));
  sum += sizeof(next) / sizeof(double);
}

/** w N of one pair times J^T from the left, J = (I, -P), P x = d x x. */
struct LanesOfPair {
  Lanes w, d[3], e[3], W[3][3];
};

PCL6D_INLINE void
crossed(const Lanes* d, const Lanes* x, Lanes* result)
{
  result[0] = d[1] * x[2] - d[2] * x[1];
  result[1] = d[2] * x[0] - d[0] * x[2];
  result[2] = d[0] * x[1] - d[1] * x[0];
}

/** The 21 entries of A and the 6 of b. */
PCL6D_INLINE void
addEquations(const LanesOfPair& pair, double*& sum)
{
  Lanes PW[3][3]; // by columns; W is symmetric
  for (int column = 0; column < 3; ++column)
    crossed(pair.d, pair.W[column], PW[column]);
  for (int row = 0; row < 3; ++row)
    for (int column = row; column < 3; ++column)
      addTo(sum, pair.W[row][column]);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      addTo(sum, PW[column][row]);
  for (int row = 0; row < 3; ++row) { // (P W) P^T: the rows of P W, crossed
    const Lanes of_row[3] = {PW[0][row], PW[1][row], PW[2][row]};
    Lanes PWP[3];
    crossed(pair.d, of_row, PWP);
    for (int column = row; column < 3; ++column)
      addTo(sum, PWP[column]);
  }
}

/** Sums independent of N: W, W c_d, the squared distances and the scatter. */
PCL6D_INLINE void
addMoments(const LanesOfPair& pair, double*& sum)
{
  const Lanes *d = pair.d, *e = pair.e;
  addTo(sum, pair.w);
  addTo(sum, pair.w * (e[0] * e[0] + e[1] * e[1] + e[2] * e[2]));
  for (int row = 0; row < 3; ++row)
    addTo(sum, pair.w * d[row]);
  for (int row = 0; row < 3; ++row)
    for (int column = row; column < 3; ++column)
      addTo(sum, pair.w * d[row] * d[column]);
}

/** Reads the sums of the lanes in the order of addLanes(). */
class SumsReader {
public:
  explicit SumsReader(const double (*sums)[8]) : sums_(sums) {}

  double
  next()
  {
    const double* lane = *sums_++;
    return ((lane[0] + lane[4]) + (lane[2] + lane[6])) +
           ((lane[1] + lane[5]) + (lane[3] + lane[7]));
  }

  Eigen::Matrix3d
  nextSymmetric()
  {
    Eigen::Matrix3d matrix;
    for (int row = 0; row < 3; ++row)
      for (int column = row; column < 3; ++column)
        matrix(row, column) = matrix(column, row) = next();
    return matrix;
  }

  Eigen::Vector3d
  nextVector()
  {
    Eigen::Vector3d v;
    for (double& x : v)
      x = next();
    return v;
  }

private:
  const double (*sums_)[8];
};
} // namespace

PCL6D_SIMD_CLONES void
PlaneAccumulator::addLanes(const Waiting& waiting, double (*sums)[kLanes])
{
  LanesOfPair pair;
  load(pair.w, waiting.weight);
  int entry = 0;
  for (int row = 0; row < 3; ++row) {
    load(pair.d[row], waiting.source[row]);
    load(pair.e[row], waiting.error[row]);
    for (int column = row; column < 3; ++column) {
      Lanes norm;
      load(norm, waiting.norm[entry++]);
      pair.W[row][column] = pair.W[column][row] = pair.w * norm;
    }
  }
  Lanes We[3], moment[3];
  for (int row = 0; row < 3; ++row)
    We[row] = pair.W[row][0] * pair.e[0] + pair.W[row][1] * pair.e[1] +
              pair.W[row][2] * pair.e[2];
  crossed(pair.d, We, moment);
  double* sum = *sums;
  addEquations(pair, sum);
  for (const Lanes& force : We)
    addTo(sum, force);
  for (const Lanes& of_row : moment)
    addTo(sum, of_row);
  addTo(sum, pair.e[0] * We[0] + pair.e[1] * We[1] + pair.e[2] * We[2]);
  addMoments(pair, sum);
}

/** \return whether the pair is valid; its lane then has every value but N */
bool
PlaneAccumulator::begin(const Eigen::Vector3d& source,
                        const Eigen::Vector3d& target,
                        double weight)
{
  if (!source.allFinite() || !target.allFinite())
    return false;
  if (count_ == 0)
    origin_ = source;
  const std::size_t lane = waiting_.count;
  waiting_.weight[lane] = weight;
  for (int axis = 0; axis < 3; ++axis) {
    waiting_.source[axis][lane] = source[axis] - origin_[axis];
    waiting_.error[axis][lane] = target[axis] - source[axis];
  }
  return true;
}

void
PlaneAccumulator::end()
{
  ++count_;
  if (++waiting_.count < kLanes)
    return;
  addLanes(waiting_, sums_);
  waiting_.count = 0;
}

void
PlaneAccumulator::add(const Eigen::Vector3d& source,
                      const Eigen::Vector3d& target,
                      const Eigen::Vector3d& normal,
                      double weight)
{
  const double length_sq = normal.squaredNorm();
  if (!normal.allFinite() || length_sq == 0 || !begin(source, target, weight))
    return;
  int entry = 0;
  for (int row = 0; row < 3; ++row)
    for (int column = row; column < 3; ++column)
      waiting_.norm[entry++][waiting_.count] = normal[row] * normal[column] / length_sq;
  end();
}

void
PlaneAccumulator::addNorm(const Eigen::Vector3d& source,
                          const Eigen::Vector3d& target,
                          const Eigen::Matrix3d& N,
                          double weight)
{
  if (!N.allFinite() || !begin(source, target, weight))
    return;
  int entry = 0;
  for (int row = 0; row < 3; ++row)
    for (int column = row; column < 3; ++column)
      waiting_.norm[entry++][waiting_.count] = N(row, column);
  end();
}

void
PlaneAccumulator::addPlanes(const Eigen::Vector3d& source,
                            const Eigen::Vector3d& target,
                            const Eigen::Vector3d& n,
                            const Eigen::Vector3d& m,
                            double epsilon,
                            double weight)
{
  if (!n.allFinite() || !m.allFinite() || !begin(source, target, weight))
    return;
  double N[6];
  planesNorm(n, m, epsilon, N);
  for (int entry = 0; entry < 6; ++entry)
    waiting_.norm[entry][waiting_.count] = N[entry];
  end();
}

PlaneSums
PlaneAccumulator::sums() const
{
  PlaneSums sums;
  sums.count = count_;
  if (count_ == 0)
    return sums;
  double all[kSums][kLanes];
  std::memcpy(all, sums_, sizeof(all));
  if (waiting_.count > 0) {
    Waiting rest = waiting_;
    std::fill(rest.weight + rest.count, rest.weight + kLanes, 0.0);
    addLanes(rest, all);
  }
  SumsReader reader(all);
  sums.A.topLeftCorner<3, 3>() = reader.nextSymmetric();
  for (int row = 3; row < 6; ++row)
    for (int column = 0; column < 3; ++column)
      sums.A(row, column) = sums.A(column, row) = reader.next();
  sums.A.bottomRightCorner<3, 3>() = reader.nextSymmetric();
  sums.b.head<3>() = reader.nextVector();
  sums.b.tail<3>() = reader.nextVector();
  sums.residual_sq = reader.next();
  sums.weight = reader.next();
  sums.distance_sq = reader.next();
  const Eigen::Vector3d mean = reader.nextVector() / sums.weight;
  sums.scatter = reader.nextSymmetric();
  moveOrigin(sums, mean);
  sums.mean_source = origin_ + mean;
  sums.scatter -= sums.weight * mean * mean.transpose();
  return sums;
}

} // namespace pcl6d
