// SPDX-License-Identifier: BSD-3-Clause
#include "peer_ratio.h"
#include "room_cloud.h"

#include <pcl6d/registration/icp6d.h>

#include <pcl/registration/icp.h>

#include <memory>

namespace pcl6d::benchmarks {

namespace {
constexpr char kPeer[] = "pcl::IterativeClosestPoint";
constexpr int kIterations = 40;
constexpr double kGate = 0.25; // [m]
// Both take the same steps, but PCL moves its points in float, step upon step: half an
// ulp of a coordinate below 8 m and of a rotation, 40 times, is 1e-5 m. Times 10, as a
// pair may change its partner for it.
constexpr double kPositionTol = 1e-4; // [m]
constexpr double kAngleTol = 1e-4;    // [rad]

/** Lets the check see how many iterations the peer took. */
class PeerIcp : public pcl::IterativeClosestPoint<Point, Point> {
public:
  int
  iterations() const
  {
    return nr_iterations_;
  }
};

/** Two scans of a room, a first guess, and what the two programs made of them. */
struct Pair {
  explicit Pair(std::size_t count)
  : target(roomCloud(count, Eigen::Isometry3d::Identity(), 1))
  , source(roomCloud(count, truth, 2))
  {}
  Eigen::Isometry3d truth = poseFromEuler({0.6, 0.3, 0.02}, {0.01, -0.01, 0.15});
  Eigen::Matrix4f guess =
      (truth * poseFromEuler({0.08, -0.06, 0.03}, {0.01, -0.01, 0.03}))
          .matrix()
          .cast<float>();
  Cloud::Ptr target;
  Cloud::Ptr source;
  Eigen::Matrix4f ours, theirs; // T_target_source
  int our_iterations = 0, their_iterations = 0;
};

void
alignOurs(Pair& pair, unsigned int threads)
{
  pcl6d::ICP6D<Point, Point> icp;
  icp.setNumberOfThreads(threads);
  icp.setSearchMethodTarget(pcl::make_shared<pcl6d::KdTree<Point>>(threads));
  icp.setInputTarget(pair.target);
  icp.setInputSource(pair.source);
  icp.setMaximumIterations(kIterations);
  icp.setMaxCorrespondenceDistance(kGate);
  icp.setMotionEpsilon(0, 0);
  Cloud aligned;
  icp.align(aligned, pair.guess);
  pair.ours = icp.getFinalTransformation();
  pair.our_iterations = icp.result().iterations;
}

void
alignTheirs(Pair& pair)
{
  PeerIcp icp;
  icp.setInputTarget(pair.target);
  icp.setInputSource(pair.source);
  icp.setMaximumIterations(kIterations);
  icp.setMaxCorrespondenceDistance(kGate);
  icp.getConvergeCriteria()->setAbsoluteMSE(0); // or it stops early
  Cloud aligned;
  icp.align(aligned, pair.guess);
  pair.theirs = icp.getFinalTransformation();
  pair.their_iterations = icp.iterations();
}

/** \return how far an estimate is from the truth; made exactly rigid before */
MotionSize
errorOf(const Pair& pair, const Eigen::Matrix4f& estimate)
{
  Eigen::Isometry3d pose(estimate.cast<double>());
  pose.linear() = Eigen::Quaterniond(pose.linear()).normalized().toRotationMatrix();
  return distanceBetween(pair.truth, pose);
}

void
checkEquallyGood(benchmark::State& state, const Pair& pair)
{
  const MotionSize ours = errorOf(pair, pair.ours);
  const MotionSize theirs = errorOf(pair, pair.theirs);
  if (pair.our_iterations != kIterations || pair.their_iterations != kIterations)
    return state.SkipWithError("the numbers of iterations differ");
  if (ours.translation > theirs.translation + kPositionTol ||
      ours.rotation > theirs.rotation + kAngleTol)
    return state.SkipWithError("our pose is farther from the truth than the peer's");
  state.counters["ours_err_mm"] = 1e3 * ours.translation;
  state.counters["peer_err_mm"] = 1e3 * theirs.translation;
  state.counters["ours_err_mrad"] = 1e3 * ours.rotation;
  state.counters["peer_err_mrad"] = 1e3 * theirs.rotation;
}

PeerJob
alignJob(std::size_t count, unsigned int threads)
{
  const auto pair = std::make_shared<Pair>(count);
  return {[=] { alignOurs(*pair, threads); },
          [=] { alignTheirs(*pair); },
          [=](benchmark::State& state) { checkEquallyGood(state, *pair); }};
}
} // namespace

} // namespace pcl6d::benchmarks

int
main(int argc, char** argv)
{
  using namespace pcl6d::benchmarks;
  for (const std::size_t count : {30000, 100000})
    for (const unsigned int threads : {1u, 2u})
      addPeerCase({"icp/" + std::to_string(count), kPeer, threads, 7, [=] {
                     return alignJob(count, threads);
                   }});
  return runPeerCases(argc, argv);
}
