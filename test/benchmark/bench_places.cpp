// SPDX-License-Identifier: BSD-3-Clause
// Pairs of scans with a reference, placed without a guess: how many right places are found,
// by overlap, and what is said of wrong ones.
// usage: bench_places [every=N] [scans=N] [pairs=N] [verbose=1] FOLDER ...
#include "verification_links.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/common/random.h>
#include <pcl6d/global_registration/place_search.h>
#include <pcl6d/verification/surface_fit.h>

#include <chrono>
#include <cstdlib>
#include <deque>
#include <iostream>
#include <map>
#include <string>
#include <vector>

namespace pcl6d::bench {

namespace {
constexpr double kRightWay = 0.5, kRightTurn = 0.087; // 5 deg

/** Of pairs of one class of overlap. */
struct Tally {
  int pairs = 0, first = 0, any = 0;
  int unique_right = 0, unique_wrong = 0;
  double seconds = 0;
};

double
overlapAt(const LinkSet& set, std::size_t i, std::size_t j, const Eigen::Isometry3d& T)
{
  SurfaceFitOptions options;
  options.max_distance = 3 * set.voxel;
  options.covariance = false;
  return fitSurfaces(set.scans[i], set.scans[j], T, options).overlap;
}

int
classOf(double overlap)
{
  return overlap < 0.1   ? 0
         : overlap < 0.3 ? 1
         : overlap < 0.5 ? 2
         : overlap < 0.7 ? 3
                         : 4;
}

void
judge(const LinkSet& set,
      const std::deque<PlaceableScan>& scans,
      std::size_t i,
      std::size_t j,
      bool verbose,
      std::map<int, Tally>& tallies)
{
  const Eigen::Isometry3d truth = set.T_world_scan[i].inverse() * set.T_world_scan[j];
  const double overlap = overlapAt(set, i, j, truth);
  Tally& tally = tallies[classOf(overlap)];
  PlaceSearchOptions options;
  options.num_threads = 1;
  const auto start = std::chrono::steady_clock::now();
  const PlaceResult found = placeScan(scans[i], scans[j], options);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  ++tally.pairs;
  tally.seconds += spent.count();
  int right = -1;
  for (std::size_t k = 0; k < found.candidates.size() && right < 0; ++k) {
    const MotionSize off = distanceBetween(truth, found.candidates[k].T_first_second);
    if (off.translation < kRightWay && off.rotation < kRightTurn)
      right = static_cast<int>(k);
  }
  tally.first += right == 0;
  tally.any += right >= 0;
  tally.unique_right += found.answer == PlaceAnswer::kUnique && right == 0;
  tally.unique_wrong += found.answer == PlaceAnswer::kUnique && right != 0;
  if (!verbose)
    return;
  std::cout << set.name << ' ' << i << ' ' << j << " overlap " << overlap << " right "
            << right << ' ' << toString(found.answer) << ' ' << spent.count() << " s:";
  for (const auto& one : found.candidates) {
    const MotionSize off = distanceBetween(truth, one.T_first_second);
    std::cout << " [" << one.score << ' ' << one.overlap << ' ' << one.contradiction
              << ' ' << one.evidence.sight.patches << ' '
              << one.opinion.probability_wrong << " | " << off.translation << ' '
              << off.rotation << ']';
  }
  const PlaceCandidate at_truth = judgePlace(scans[i], scans[j], truth);
  const MotionSize off = distanceBetween(truth, at_truth.T_first_second);
  std::cout << " truth: [" << at_truth.score << ' ' << at_truth.overlap << ' '
            << at_truth.contradiction << " | " << off.translation << ' ' << off.rotation
            << "]\n";
}

int
run(const std::vector<std::string>& arguments)
{
  std::map<std::string, int> knobs{
      {"every", 1}, {"scans", 60}, {"pairs", 40}, {"verbose", 0}};
  for (const std::string& argument : arguments) {
    const auto equals = argument.find('=');
    if (equals != std::string::npos) {
      knobs.at(argument.substr(0, equals)) = std::atoi(argument.c_str() + equals + 1);
      continue;
    }
    const LinkSet set =
        readLinkSet(argument, knobs["every"], static_cast<std::size_t>(knobs["scans"]));
    std::deque<PlaceableScan> scans;
    for (const auto& scan : set.scans) {
      scans.emplace_back(scan);
      if (knobs["verbose"] > 1)
        std::cout << "up " << scans.back().vertical().up.transpose() << " share "
                  << scans.back().vertical().share << " sure "
                  << scans.back().vertical().is_sure << " others "
                  << scans.back().vertical().others.size() << " cell "
                  << scans.back().cell() << " voxel " << set.voxel << '\n';
    }
    Random random(1);
    std::map<int, Tally> tallies;
    std::map<int, int> wanted; // pairs of each class
    for (int trial = 0; trial < 4000; ++trial) {
      const auto i = static_cast<std::size_t>(random.uniform() * scans.size());
      const auto j = static_cast<std::size_t>(random.uniform() * scans.size());
      if (i == j)
        continue;
      const double overlap =
          overlapAt(set, i, j, set.T_world_scan[i].inverse() * set.T_world_scan[j]);
      if (wanted[classOf(overlap)]++ < knobs["pairs"] / 5)
        judge(set, scans, i, j, knobs["verbose"] > 0, tallies);
    }
    const char* const names[] = {"< 0.1", "< 0.3", "< 0.5", "< 0.7", "above"};
    for (const auto& [overlap, tally] : tallies)
      std::cout << set.name << " overlap " << names[overlap] << ": " << tally.pairs
                << " pairs, first " << tally.first << ", among candidates " << tally.any
                << ", unique " << tally.unique_right << " right " << tally.unique_wrong
                << " wrong, " << tally.seconds / tally.pairs << " s\n";
  }
  return 0;
}
} // namespace

} // namespace pcl6d::bench

int
main(int argc, char** argv)
{
  return pcl6d::bench::run({argv + 1, argv + argc});
}
