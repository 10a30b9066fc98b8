// SPDX-License-Identifier: BSD-3-Clause
// Plane segmentation: our methods beside PCL's, in seconds and in what they find.
#include "peer_ratio.h"
#include "plane_methods.h"
#include "plane_sac_cases.h"
#include "plane_scans.h"

#include <pcl6d/benchmarking/plane_score.h>

#include <cmath>
#include <cstdio>

namespace pcl6d::benchmarks {

namespace {
/** True planes with fewer points are not asked for: those that the rays graze far away,
 * of which a second table keeps the larger half. */
constexpr std::size_t kMinPoints[] = {250, 100};

/** What a method does on several scans. */
struct MethodRow {
  double seconds = 0; ///< per scan
  std::size_t scans = 0, planes = 0, asked = 0, correct = 0, over = 0, under = 0;
  std::size_t missed = 0, noise = 0;
  std::vector<PlaneMatch> matches{};

  void
  add(const FoundPlanes& found, const PlaneScan& scan, std::size_t min_points)
  {
    ++scans;
    seconds += found.seconds;
    planes += found.planes.size();
    PlaneScoreOptions options;
    options.min_points = min_points;
    const PlaneScore score =
        scorePlanes(found.numbers, found.planes, scan.truth, scan.planes, options);
    asked += score.asked;
    correct += score.correct.size();
    over += score.over_segmented;
    under += score.under_segmented;
    missed += score.missed;
    noise += score.noise;
    matches.insert(matches.end(), score.correct.begin(), score.correct.end());
  }

  void
  print(const std::string& name) const
  {
    PlaneScore all;
    all.correct = matches;
    const auto per_scan = 1 / static_cast<double>(scans);
    std::printf("| %s | %.3f | %.1f | %.1f | %zu | %zu | %zu | %zu | %.3f | %.1f |\n",
                name.c_str(),
                seconds * per_scan,
                static_cast<double>(planes) * per_scan,
                100 * static_cast<double>(correct) / static_cast<double>(asked),
                over,
                under,
                missed,
                noise,
                all.medianNormalError() * 180 / M_PI,
                1e3 * all.medianOffsetError());
  }
};

/** The table of Hoover et al. over some scans. */
void
printScores(const std::vector<PlaneMethodCase>& methods,
            const std::vector<PlaneScan>& scans,
            std::size_t min_points,
            unsigned int threads)
{
  std::size_t points = 0;
  for (const auto& scan : scans)
    points += scan.points.size() / scans.size();
  std::printf(
      "\n%zu scans of rooms, %zu points each, 1 cm noise, %u threads; "
      "true planes of at least %zu points\n\n"
      "| method | seconds | planes | correct %% | over | under | missed | noise "
      "| normal [deg] | offset [mm] |\n|---|---|---|---|---|---|---|---|---|---|\n",
      scans.size(),
      points,
      threads,
      min_points);
  for (const auto& method : methods) {
    MethodRow row;
    for (const auto& scan : scans)
      row.add(method.find(scan.points, threads), scan, min_points);
    row.print(method.name);
  }
  std::printf("\n");
}

void
addRatios(const std::vector<unsigned int>& threads)
{
  const auto scan = kurt3dScan();
  if (!scan) {
    std::fprintf(stderr, "kurt3d is left out: set PCL6D_DATA\n");
    return;
  }
  for (const auto count : threads)
    for (const auto& ours : ourPlaneMethods())
      for (const auto& theirs : peerPlaneMethods())
        addPeerCase({"planes_" + ours.name + "/kurt3d-001", theirs.name, count, 3, [=] {
                       return PeerJob{[=] { ours.find(*scan, count); },
                                      [=] { theirs.find(*scan, 1); },
                                      [=](benchmark::State& state) {
                                        const auto found = ours.find(*scan, count);
                                        state.counters["planes"] =
                                            static_cast<double>(found.planes.size());
                                        if (found.planes.size() < 6)
                                          state.SkipWithError("fewer than 6 planes");
                                      }};
                     }});
}
} // namespace

} // namespace pcl6d::benchmarks

int
main(int argc, char** argv)
{
  using namespace pcl6d::benchmarks;
  const auto threads = takeThreadCounts(argc, argv);
  auto methods = ourPlaneMethods();
  for (const auto& peer : peerPlaneMethods())
    methods.push_back(peer);
  const auto rooms = simulatedRooms();
  for (const auto min_points : kMinPoints)
    printScores(methods, rooms, min_points, threads.back());
  addRatios(threads);
  addPlaneSacCases(threads);
  return runPeerCases(argc, argv);
}
