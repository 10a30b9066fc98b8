// SPDX-License-Identifier: BSD-3-Clause
// Clouds whose i-th points are pairs, so near that the target's is also the nearest,
// and oracles that know the best motion between them.
#pragma once

#include "estimations.h"
#include "support/fit_oracles.h"
#include "support/pairs.h"

#include <Eigen/QR>

#include <cmath>
#include <functional>
#include <numeric>

namespace pcl6d::test {

/** \brief What pairs say about the motion. */
enum class Outcome {
  kPose,  ///< they fix it
  kOpen,  ///< they leave some motion open
  kTooFew ///< they are two, which leaves a motion open, too, and is too few for ICP
};

struct Scene {
  std::string name;
  NormalCloud::Ptr source = pcl::make_shared<NormalCloud>();
  NormalCloud::Ptr target = pcl::make_shared<NormalCloud>();
  Eigen::Isometry3d truth = Eigen::Isometry3d::Identity(); ///< source to target
  Outcome to_points = Outcome::kPose;
  Outcome to_planes = Outcome::kPose;
  /** of ICP6D where the pairs of points fix the pose: it also asks the surfaces */
  Status surfaces = Status::kOk;
  /** of what computes in double, about the centroid [m], [rad] */
  MotionSize exact_tol{1e-9, 1e-9};
  /** of PCL's ICP, which moves the float points anew in each iteration. Here they are
   * up to 32 m from the origin: steps under half an ulp, 1e-6 m, move no point, but are
   * added up to the pose, in up to 100 iterations. */
  MotionSize pcl_tol{1e-4, 1e-5};

  Outcome
  outcome(Goal goal) const
  {
    return goal == Goal::kPlanes ? to_planes : to_points;
  }

  /** \return the points as the clouds hold them, that is, after rounding to float */
  Pairs
  pairs() const
  {
    Pairs pairs;
    for (std::size_t i = 0; i < source->size(); ++i) {
      pairs.source.push_back((*source)[i].getVector3fMap().cast<double>());
      pairs.target.push_back((*target)[i].getVector3fMap().cast<double>());
    }
    return pairs;
  }

  Eigen::Vector3d
  sourceCentroid() const
  {
    return pairs().sums().mean_source;
  }
};

inline void
PrintTo(const Scene& scene, std::ostream* out)
{
  *out << scene.name;
}

constexpr double kNoise = 0.02; ///< [m] of a coordinate in the noisy scene

using Lattice = std::vector<Eigen::Vector3d>;

/** \return points 2 m apart, each off its place by up to jitter [m] */
inline Lattice
lattice(const Eigen::Vector3i& counts, const Eigen::Vector3d& jitter)
{
  Random random(1);
  Lattice points;
  for (int x = 0; x < counts.x(); ++x)
    for (int y = 0; y < counts.y(); ++y)
      for (int z = 0; z < counts.z(); ++z)
        points.push_back(2.0 * Eigen::Vector3d(x, y, z) +
                         randomVector(random, 1).cwiseProduct(jitter));
  return points;
}

/** What is done to a scene besides the motion. */
struct Change {
  double sigma = 0;                                 ///< [m] of the target's noise
  Eigen::Vector3d mirror = Eigen::Vector3d::Ones(); ///< factors of the source's axes
  std::function<Eigen::Vector3d(Random&)> normal = [](Random& random) {
    return normalVector(random, 1);
  };
};

/** Moves the points by a small motion about their centroid. */
inline Scene
makeScene(const std::string& name, const Lattice& points, const Change& change = {})
{
  Random random(2);
  Scene scene;
  scene.name = name;
  const Eigen::Vector3d centre =
      std::accumulate(
          points.begin(), points.end(), Eigen::Vector3d(Eigen::Vector3d::Zero())) /
      static_cast<double>(points.size());
  scene.truth = Eigen::Translation3d(centre) *
                poseFromEuler({0.05, -0.04, 0.03}, {0.004, -0.003, 0.01}) *
                Eigen::Translation3d(-centre);
  for (const auto& p : points) {
    NormalPoint source, target;
    source.getVector3fMap() = p.cast<float>();
    const Eigen::Vector3d stored = source.getVector3fMap().cast<double>();
    const Eigen::Vector3d m = centre + change.mirror.cwiseProduct(stored - centre);
    target.getVector3fMap() =
        (scene.truth * m + normalVector(random, change.sigma)).cast<float>();
    const Eigen::Vector3d n = change.normal(random).normalized();
    source.getNormalVector3fMap() = n.cast<float>();
    target.getNormalVector3fMap() = (scene.truth.linear() * n).cast<float>();
    scene.source->push_back(source);
    scene.target->push_back(target);
  }
  return scene;
}

inline Lattice
movedLattice(Lattice points, const Eigen::Isometry3d& motion)
{
  for (auto& p : points)
    p = motion * p;
  return points;
}

inline Scene
planarScene()
{
  const Eigen::Isometry3d plane = poseFromEuler({16, -8, 4}, {0.5, -0.3, 0.7});
  Change change;
  change.normal = [plane](Random&) { return Eigen::Vector3d(plane.linear().col(2)); };
  Scene scene = makeScene(
      "Planar", movedLattice(lattice({14, 12, 1}, {0.4, 0.4, 0}), plane), change);
  scene.to_planes = Outcome::kOpen;
  return scene;
}

inline Scene
collinearScene()
{
  const Eigen::Vector3d along(0.5, 1, 1.5);
  Lattice points;
  for (int i = 0; i < 20; ++i)
    points.emplace_back(i * along); // exact in float
  Change change;                    // normals of a thin bar
  change.normal = [along](Random& random) {
    return Eigen::Vector3d(along.cross(normalVector(random, 1)));
  };
  Scene scene = makeScene("Collinear", points, change);
  scene.to_points = scene.to_planes = Outcome::kOpen;
  return scene;
}

/** \return a slab, mirrored across its thickness so that pairs stay near each other */
inline Scene
mirroredScene(const Eigen::Isometry3d& place)
{
  Change change;
  change.mirror.z() = -1;
  Scene scene = makeScene(
      "Mirrored", movedLattice(lattice({14, 10, 1}, {0.4, 0.4, 0.3}), place), change);
  scene.surfaces = Status::kRankDeficient; // nearly a plane
  return scene;
}

/** Both clouds 1e6 m from the origin along each axis, where float holds sixteenths of a
 * metre: the same to all as noise of 0.018 m. */
inline Scene
farScene(const Lattice& points)
{
  Scene scene =
      makeScene("Far", movedLattice(points, poseFromEuler({1e6, -1e6, 1e6}, {})));
  scene.exact_tol.translation = 1e-8; // a coordinate in double: 1e-10
  // PCL's ICP multiplies in float: about four roundings of 0.03 m per coordinate, alike
  // in all points. It comes to 0.22 m and 7 mrad, farther off than it started (0.07 m).
  scene.pcl_tol = {0.4, 0.02};
  return scene;
}

inline std::vector<Scene>
pairScenes()
{
  const Eigen::Isometry3d place = poseFromEuler({16, -8, 4}, {});
  const Lattice cube = lattice({6, 6, 6}, {0.4, 0.4, 0.4});
  Change noise;
  noise.sigma = kNoise;
  Scene two = makeScene("TwoPoints", {cube[0], cube[100]});
  two.to_points = two.to_planes = Outcome::kTooFew;
  return {makeScene("NoiseFree", movedLattice(cube, place)),
          makeScene("Noisy", movedLattice(cube, place), noise),
          planarScene(),
          collinearScene(),
          mirroredScene(place),
          two,
          farScene(cube)};
}

/** \return the motion that is best from points to planes: Gauss and Newton by a QR
 * decomposition, about the centroid */
inline Eigen::Isometry3d
planeOracle(const Scene& scene)
{
  const Pairs pairs = scene.pairs();
  const Eigen::Vector3d origin = scene.sourceCentroid();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity(); // about origin
  Eigen::MatrixXd J(pairs.source.size(), 6);
  Eigen::VectorXd distance(pairs.source.size());
  for (int step = 0; step < 20; ++step) {
    for (std::size_t i = 0; i < pairs.source.size(); ++i) {
      const Eigen::Vector3d n =
          (*scene.target)[i].getNormalVector3fMap().cast<double>().normalized();
      const Eigen::Vector3d p = T * (pairs.source[i] - origin);
      J.row(i) << p.cross(n).transpose(), n.transpose();
      distance(i) = n.dot(pairs.target[i] - origin - p);
    }
    const Eigen::VectorXd x = leastSquares(J, distance);
    Eigen::Isometry3d motion(Eigen::Translation3d(x.tail<3>()));
    motion.linear() = rotationFromVector(x.head<3>());
    T = motion * T;
  }
  return Eigen::Translation3d(origin) * T * Eigen::Translation3d(-origin);
}

/** \return the scale that fits the pairs best, by Eigen's Umeyama */
inline double
scaleOracle(const Pairs& pairs)
{
  Eigen::Matrix3Xd d(3, pairs.source.size()), m(3, pairs.source.size());
  for (std::size_t i = 0; i < pairs.source.size(); ++i) {
    d.col(i) = pairs.source[i];
    m.col(i) = pairs.target[i];
  }
  return std::cbrt(umeyama(d, m, true).topLeftCorner<3, 3>().determinant());
}

} // namespace pcl6d::test
