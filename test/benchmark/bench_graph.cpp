// SPDX-License-Identifier: BSD-3-Clause
#include "peer_ratio.h"
#include "support/ceres_graph.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/common/random.h>
#include <pcl6d/graph_relaxation/pose_graph_optimizer.h>
#include <pcl6d/io/pose_graph_io.h>

#include <cmath>
#include <dlfcn.h>
#include <filesystem>
#include <fstream>
#include <memory>

namespace pcl6d::benchmarks {

namespace {
constexpr double kChi2Epsilon = 1e-8; // of both: the share of the last step
constexpr double kSameChi2 = 1e-6;    // relative

/** The folder of the recorded graphs, see test/support/data_folder.h. */
std::filesystem::path
graphFolder()
{
  const char* root = std::getenv("PCL6D_DATA");
  return (root
              ? std::filesystem::path(root)
              : std::filesystem::path(PCL6D_SOURCE_DIR).parent_path() / "shared/data") /
         "graphs";
}

/** Along the streets of a campus of 250 m, at crossings straight on or around a corner. */
std::vector<Eigen::Isometry3d>
driveThroughStreets(std::size_t num_poses, Random& random)
{
  constexpr double kStreet = 50; // [m]
  constexpr int kStreets = 5;
  std::vector<Eigen::Isometry3d> poses;
  Eigen::Vector2i corner(0, 0), way(1, 0);
  for (double along = 0; poses.size() < num_poses; along += 1) {
    if (along >= kStreet) { // at a crossing, turn to where there is a street
      along = 0;
      corner += way;
      Eigen::Vector2i next = way;
      do {
        const double choice = random.uniform();
        next = choice < 0.4   ? way
               : choice < 0.7 ? Eigen::Vector2i(-way.y(), way.x())
                              : Eigen::Vector2i(way.y(), -way.x());
      } while (((corner + next).array() < 0).any() ||
               ((corner + next).array() > kStreets).any());
      way = next;
    }
    const Eigen::Vector2d place =
        kStreet * corner.cast<double>() + along * way.cast<double>();
    poses.push_back(
        poseFromEuler({place.x(), place.y(), 0.02 * place.x()},
                      {0, 0, std::atan2(double(way.y()), double(way.x()))}));
  }
  return poses;
}

/** A measured motion. */
Eigen::Isometry3d
noisy(const Eigen::Isometry3d& motion, Random& random)
{
  const auto draw = [&](double sigma) -> Eigen::Vector3d {
    return Eigen::Vector3d::NullaryExpr([&] { return sigma * random.normal(); });
  };
  Eigen::Isometry3d error = Eigen::Isometry3d::Identity();
  error.linear() = rotationFromVector(draw(0.0005));
  error.translation() = draw(0.01);
  return motion * error;
}

/** A robot that measures from every place on a campus its way to the next and to two places
 * near by. The start is the chain. */
PoseGraph
campus(std::size_t num_poses, std::size_t num_links)
{
  Random random(5);
  PoseGraph graph;
  graph.poses = driveThroughStreets(num_poses, random);
  PoseLink link;
  link.information.diagonal() << 1e4, 1e4, 1e4, 4e6, 4e6, 4e6;
  const auto add = [&](std::size_t a, std::size_t b) {
    link.from = a;
    link.to = b;
    link.T_from_to = noisy(graph.poses[a].inverse() * graph.poses[b], random);
    graph.links.push_back(link);
  };
  for (std::size_t i = 0; i + 1 < num_poses; ++i)
    add(i, i + 1);
  while (graph.links.size() < num_links) {
    const auto draw = [&] {
      return static_cast<std::size_t>(random.uniform() *
                                      static_cast<double>(num_poses));
    };
    const std::size_t a = draw(), b = draw();
    const double distance =
        (graph.poses[a].translation() - graph.poses[b].translation()).norm();
    if (a + 1 < b && distance < 5)
      add(a, b);
  }
  for (std::size_t i = 0; i + 1 < num_poses; ++i)
    graph.poses[i + 1] = graph.poses[i] * graph.links[i].T_from_to;
  return graph;
}

/** CHOLMOD's time is that of its BLAS: as many threads as we use. */
void
limitBlas(unsigned int threads)
{
  using SetThreads = void (*)(int);
  if (const auto set =
          reinterpret_cast<SetThreads>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads")))
    set(static_cast<int>(threads));
}

/** \return the file of the BLAS that is loaded */
std::string
blasName()
{
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);)
    if (line.find("blas") != std::string::npos && line.find('/') != std::string::npos)
      return line.substr(line.find('/'));
  return "none";
}

struct Peer {
  const char* name;
  ceres::SparseLinearAlgebraLibraryType library;
};

PeerJob
optimizeJob(const std::shared_ptr<const PoseGraph>& graph,
            const Peer& peer,
            unsigned int threads)
{
  const auto ours = std::make_shared<PoseGraphResult>();
  const auto theirs = std::make_shared<double>(0);
  PoseGraphOptions options;
  options.chi2_epsilon = kChi2Epsilon;
  options.num_threads = threads;
  return {[=] { *ours = PoseGraphOptimizer(*graph, options).optimize(); },
          [=] {
            limitBlas(threads);
            test::optimizeByCeres(
                *graph, peer.library, kChi2Epsilon, int(threads), theirs.get());
          },
          [=](benchmark::State& state) {
            state.counters["chi2"] = ours->chi2_after;
            state.counters["iterations"] = ours->iterations;
            if (ours->status != Status::kOk)
              state.SkipWithError("ours did not converge");
            else if (!(ours->chi2_after <= (1 + kSameChi2) * *theirs &&
                       *theirs <= (1 + kSameChi2) * ours->chi2_after))
              state.SkipWithError("the two ended at different chi2");
          }};
}

void
addCases(const std::string& name,
         const std::shared_ptr<const PoseGraph>& graph,
         const std::vector<unsigned int>& thread_counts)
{
  constexpr Peer kPeers[] = {{"ceres-eigen", ceres::EIGEN_SPARSE},
                             {"ceres-cholmod", ceres::SUITE_SPARSE}};
  const std::string size = "/" + std::to_string(graph->poses.size());
  const int repetitions = graph->poses.size() < 5000 ? 11 : 5;
  for (const Peer& peer : kPeers)
    for (const unsigned int threads : thread_counts)
      addPeerCase({"graph_" + name + size, peer.name, threads, repetitions, [=] {
                     return optimizeJob(graph, peer, threads);
                   }});
}
} // namespace

} // namespace pcl6d::benchmarks

int
main(int argc, char** argv)
{
  using namespace pcl6d::benchmarks;
  const auto thread_counts = takeThreadCounts(argc, argv);
  benchmark::AddCustomContext("BLAS", blasName());
  const auto folder = graphFolder();
  for (const auto& [name, file] : {std::pair("garage", "parking-garage.g2o"),
                                   std::pair("sphere", "sphere2500.txt")}) {
    if (std::filesystem::exists(folder / file))
      addCases(name,
               std::make_shared<pcl6d::PoseGraph>(pcl6d::readPoseGraph(folder / file)),
               thread_counts);
    else
      std::fprintf(stderr, "%s not found: left out\n", (folder / file).c_str());
  }
  addCases("campus",
           std::make_shared<pcl6d::PoseGraph>(campus(10000, 30000)),
           thread_counts);
  return runPeerCases(argc, argv);
}
