// SPDX-License-Identifier: BSD-3-Clause
#include "peer_ratio.h"
#include "recorded_pair.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/registration/pcl/icp6d.h>
#include <pcl6d/registration/pcl/ndt6d.h>

#include <pcl/registration/gicp.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/ndt.h>

#include <memory>

namespace pcl6d::benchmarks {

namespace {
using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
constexpr char kIcp[] = "pcl::IterativeClosestPoint";
constexpr char kPlanes[] = "pcl::IterativeClosestPointWithNormals";
constexpr char kNdt[] = "pcl::NormalDistributionsTransform";
constexpr char kGicp[] = "pcl::GeneralizedIterativeClosestPoint";
constexpr int kMaxIterations = 500;
// Both stop at a step of 20 micrometres: ICP's steps shrink by a few per cent each, so that
// the rest of the way is well below the tolerance.
constexpr double kTranslationEpsilon = 2e-5; // [m]
constexpr double kRotationEpsilon = 4e-6;    // [rad]
constexpr double kGicpEpsilon = 1e-4;        // [m], [rad]
constexpr double kPositionTol = 1e-3;        // [m]
constexpr double kAngleTol = 0.01 * M_PI / 180;

Cloud::Ptr
cloudOf(const Points& points)
{
  const Cloud::Ptr cloud(new Cloud);
  for (const auto& p : points)
    cloud->push_back({p.x(), p.y(), p.z()});
  return cloud;
}

/** Lets the check see how many iterations a class of PCL took. */
template <typename Icp>
class Counted : public Icp {
public:
  int
  iterations() const
  {
    return this->nr_iterations_;
  }
};

/** A recorded pair as PCL clouds, and what the two programs made of it. */
struct Work {
  explicit Work(const RecordedPair& pair)
  : target(cloudOf(pair.target))
  , source(cloudOf(pair.source))
  , guess(pair.guess.matrix().cast<float>())
  , gate(pair.gate)
  {}
  Cloud::Ptr target, source;
  Eigen::Matrix4f guess;
  double gate;
  double translation_epsilon = kTranslationEpsilon; ///< [m]
  double rotation_epsilon = kRotationEpsilon;       ///< [rad]
  Eigen::Matrix4f ours, theirs;                     // T_target_source
  int our_iterations = 0, their_iterations = 0;
  bool our_rest = false, their_rest = false;
};

/** Tree, normals and iterations of ICP6D or GICP6D. */
template <typename Icp>
void
alignOurs(Work& work, unsigned int threads)
{
  Icp icp;
  icp.setNumberOfThreads(threads);
  icp.setInputTarget(work.target);
  icp.setInputSource(work.source);
  icp.setMaximumIterations(kMaxIterations);
  icp.setMaxCorrespondenceDistance(work.gate);
  icp.setMotionEpsilon(work.translation_epsilon, work.rotation_epsilon);
  Cloud aligned;
  icp.align(aligned, work.guess);
  work.ours = icp.getFinalTransformation();
  work.our_iterations = icp.result().iterations;
  work.our_rest = icp.hasConverged();
}

void
alignTheirs(Work& work)
{
  Counted<pcl::IterativeClosestPoint<Point, Point>> icp;
  icp.setInputTarget(work.target);
  icp.setInputSource(work.source);
  icp.setMaximumIterations(kMaxIterations);
  icp.setMaxCorrespondenceDistance(work.gate);
  icp.setTransformationEpsilon(kTranslationEpsilon * kTranslationEpsilon);
  icp.getConvergeCriteria()->setAbsoluteMSE(0); // or it stops early, far from rest
  icp.getConvergeCriteria()->setRelativeMSE(0);
  Cloud aligned;
  icp.align(aligned, work.guess);
  work.theirs = icp.getFinalTransformation();
  work.their_iterations = icp.iterations();
  work.their_rest = icp.iterations() < kMaxIterations;
}

/** PCL's GICP compares each entry of the step's matrix with its thresholds. */
void
alignTheirsByPlanes(Work& work)
{
  pcl::GeneralizedIterativeClosestPoint<Point, Point> icp;
  icp.setInputTarget(work.target);
  icp.setInputSource(work.source);
  icp.setMaximumIterations(kMaxIterations);
  icp.setMaxCorrespondenceDistance(work.gate);
  icp.setTransformationEpsilon(work.translation_epsilon);
  icp.setRotationEpsilon(work.rotation_epsilon);
  Cloud aligned;
  icp.align(aligned, work.guess);
  work.theirs = icp.getFinalTransformation();
  work.their_rest = icp.hasConverged();
}

Eigen::Isometry3d
rigid(const Eigen::Matrix4f& estimate)
{
  Eigen::Isometry3d pose(estimate.cast<double>());
  pose.linear() = Eigen::Quaterniond(pose.linear()).normalized().toRotationMatrix();
  return pose;
}

void
checkEqual(benchmark::State& state, const Work& work, bool same)
{
  const MotionSize apart = distanceBetween(rigid(work.ours), rigid(work.theirs));
  state.counters["points"] = static_cast<double>(work.source->size());
  state.counters["apart_mm"] = 1e3 * apart.translation;
  state.counters["apart_mdeg"] = 1e3 * apart.rotation * 180 / M_PI;
  state.counters["our_iter"] = work.our_iterations;
  state.counters["peer_iter"] = work.their_iterations;
  if (!work.our_rest || !work.their_rest)
    return state.SkipWithError("not at rest at the iteration limit");
  if (same && (apart.translation > kPositionTol || apart.rotation > kAngleTol))
    return state.SkipWithError("the transforms differ");
}

PeerJob
icpJob(const RecordedPair& pair, unsigned int threads)
{
  const auto work = std::make_shared<Work>(pair);
  return {[=] { alignOurs<pcl6d::ICP6D<Point, Point>>(*work, threads); },
          [=] { alignTheirs(*work); },
          [=](benchmark::State& state) { checkEqual(state, *work, true); }};
}

/** The transforms are shown, not compared: PCL's stops elsewhere. As a check, ours must
 * come back to its pose when it starts from PCL's. */
PeerJob
gicpJob(const RecordedPair& pair, unsigned int threads)
{
  const auto work = std::make_shared<Work>(pair);
  work->translation_epsilon = kGicpEpsilon;
  work->rotation_epsilon = kGicpEpsilon;
  return {
      [=] { alignOurs<pcl6d::GICP6D<Point, Point>>(*work, threads); },
      [=] { alignTheirsByPlanes(*work); },
      [=](benchmark::State& state) {
        checkEqual(state, *work, false);
        Work again = *work;
        again.guess = work->theirs;
        alignOurs<pcl6d::GICP6D<Point, Point>>(again, threads);
        const auto apart = distanceBetween(rigid(work->ours), rigid(again.ours));
        state.counters["from_peer_mm"] = 1e3 * apart.translation;
        Work tight = *work; // where PCL's comes to with patience
        tight.guess = work->theirs;
        tight.translation_epsilon = tight.rotation_epsilon = 1e-7;
        alignTheirsByPlanes(tight);
        state.counters["peer_moves_mm"] =
            1e3 * distanceBetween(rigid(work->theirs), rigid(tight.theirs)).translation;
        state.counters["ours_to_tight_mm"] =
            1e3 * distanceBetween(rigid(work->ours), rigid(tight.theirs)).translation;
        if (apart.translation > kPositionTol)
          state.SkipWithError("ours started from the peer's pose ends elsewhere");
      }};
}

pcl::PointCloud<pcl::PointNormal>::Ptr
withNormals(const Cloud& cloud)
{
  Points points;
  for (const auto& p : cloud)
    points.push_back(p.getVector3fMap());
  const Normals normals = estimateNormals(points, PointTree(points));
  const pcl::PointCloud<pcl::PointNormal>::Ptr with(
      new pcl::PointCloud<pcl::PointNormal>);
  for (std::size_t i = 0; i < points.size(); ++i) {
    pcl::PointNormal point;
    point.getVector3fMap() = points[i];
    point.getNormalVector3fMap() = normals[i];
    with->push_back(point);
  }
  return with;
}

/** Points to planes; both are given the same normals. */
PeerJob
planesJob(const RecordedPair& pair, unsigned int threads)
{
  const auto work = std::make_shared<Work>(pair);
  const auto target = withNormals(*work->target), source = withNormals(*work->source);
  const auto align = [=](auto& icp) {
    icp.setInputTarget(target);
    icp.setInputSource(source);
    icp.setMaximumIterations(kMaxIterations);
    icp.setMaxCorrespondenceDistance(work->gate);
    icp.setTransformationEpsilon(kTranslationEpsilon * kTranslationEpsilon);
    pcl::PointCloud<pcl::PointNormal> aligned;
    icp.align(aligned, work->guess);
    return icp.getFinalTransformation();
  };
  return {
      [=] {
        pcl6d::ICP6DWithNormals<pcl::PointNormal, pcl::PointNormal> icp;
        icp.setNumberOfThreads(threads);
        work->ours = align(icp);
        work->our_iterations = icp.result().iterations;
        work->our_rest = icp.result().stop == IcpStop::kAtRest;
      },
      [=] {
        Counted<
            pcl::IterativeClosestPointWithNormals<pcl::PointNormal, pcl::PointNormal>>
            icp;
        icp.getConvergeCriteria()->setAbsoluteMSE(0);
        icp.getConvergeCriteria()->setRelativeMSE(0);
        work->theirs = align(icp);
        work->their_iterations = icp.iterations();
        work->their_rest = icp.iterations() < kMaxIterations;
      },
      [=](benchmark::State& state) { checkEqual(state, *work, false); }};
}

/** Cells, and steps until both rest within a millimetre, which PCL is told by its square. */
template <typename Ndt>
Eigen::Matrix4f
alignByCells(const Work& work, Ndt& ndt, double epsilon)
{
  ndt.setResolution(1);
  ndt.setTransformationEpsilon(epsilon);
  ndt.setMaximumIterations(100);
  ndt.setInputTarget(work.target);
  ndt.setInputSource(work.source);
  Cloud aligned;
  ndt.align(aligned, work.guess);
  return ndt.getFinalTransformation();
}

PeerJob
ndtJob(const RecordedPair& pair, unsigned int threads)
{
  const auto work = std::make_shared<Work>(pair);
  return {[=] {
            pcl6d::NDT6D<Point, Point> ndt;
            ndt.setNumberOfThreads(threads);
            work->ours = alignByCells(*work, ndt, 1e-3);
            work->our_iterations = ndt.getFinalNumIteration();
            work->our_rest = true;
          },
          [=] {
            pcl::NormalDistributionsTransform<Point, Point> ndt;
            work->theirs = alignByCells(*work, ndt, 1e-6);
            work->their_iterations = ndt.getFinalNumIteration();
            work->their_rest = true;
          },
          [=](benchmark::State& state) { checkEqual(state, *work, false); }};
}
} // namespace

} // namespace pcl6d::benchmarks

int
main(int argc, char** argv)
{
  using namespace pcl6d::benchmarks;
  const auto thread_counts = takeThreadCounts(argc, argv);
  for (const auto& pair : recordedPairs())
    for (const unsigned int threads : thread_counts) {
      addPeerCase({"icp/" + pair.name, kIcp, threads, 7, [=] {
                     return icpJob(pair, threads);
                   }});
      addPeerCase({"planes/" + pair.name, kPlanes, threads, 7, [=] {
                     return planesJob(pair, threads);
                   }});
      addPeerCase({"ndt/" + pair.name, kNdt, threads, 3, [=] {
                     return ndtJob(pair, threads);
                   }});
      addPeerCase({"gicp/" + pair.name, kGicp, threads, 3, [=] {
                     return gicpJob(pair, threads);
                   }});
    }
  return runPeerCases(argc, argv);
}
