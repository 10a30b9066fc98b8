// SPDX-License-Identifier: BSD-3-Clause
// Folders with a reference, their scans joined without any guess: how many are where they
// belong, how many are elsewhere, how many loose.
// usage: bench_join [every=N] [scans=N] [threads=N] [verbose=1] [ranking=1] FOLDER ...
#include "verification_links.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/global_registration/scan_joiner.h>
#include <pcl6d/verification/map_verifier.h>

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

bool
isRight(const LinkSet& set, const JoinedScans& joined, std::size_t i, std::size_t j)
{
  const MotionSize off = distanceBetween(
      set.T_world_scan[i].inverse() * set.T_world_scan[j],
      joined.scans[i].T_group_scan.inverse() * joined.scans[j].T_group_scan);
  return off.translation < kRightWay && off.rotation < kRightTurn;
}

/** \return the scan of a group with which most others agree */
std::size_t
middleOf(const LinkSet& set,
         const JoinedScans& joined,
         const std::vector<std::size_t>& group)
{
  std::size_t best = group[0], most = 0;
  for (const std::size_t i : group) {
    std::size_t right = 0;
    for (const std::size_t j : group)
      right += isRight(set, joined, i, j);
    if (right > most) {
      most = right;
      best = i;
    }
  }
  return best;
}

int
run(const std::vector<std::string>& arguments)
{
  std::map<std::string, int> knobs{
      {"every", 1}, {"scans", 60}, {"threads", 2}, {"verbose", 0}};
  for (const std::string& argument : arguments) {
    const auto equals = argument.find('=');
    if (equals != std::string::npos) {
      knobs.at(argument.substr(0, equals)) = std::atoi(argument.c_str() + equals + 1);
      continue;
    }
    const LinkSet set =
        readLinkSet(argument, knobs["every"], static_cast<std::size_t>(knobs["scans"]));
    const auto start = std::chrono::steady_clock::now();
    std::deque<PlaceableScan> scans;
    for (const auto& scan : set.scans)
      scans.emplace_back(scan);
    JoinOptions options;
    options.num_threads = static_cast<unsigned int>(knobs["threads"]);
    std::string last;
    auto since = start;
    options.progress = [&](const Progress& p) {
      if (knobs["verbose"] > 0 && p.done == p.total)
        std::cout << p.stage << ' ' << p.total << ": "
                  << std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                                   since)
                         .count()
                  << " s\n";
    };
    const JoinedScans joined = joinScans(scans, options);
    const std::chrono::duration<double> spent =
        std::chrono::steady_clock::now() - start;
    std::size_t right = 0, wrong = 0, loose = 0;
    std::cout << set.name << ": groups";
    for (const auto& group : joined.groups) {
      if (group.size() == 1) {
        ++loose;
        continue;
      }
      const std::size_t middle = middleOf(set, joined, group);
      std::size_t here = 0;
      for (const std::size_t i : group)
        here += isRight(set, joined, middle, i);
      right += here;
      wrong += group.size() - here;
      std::cout << ' ' << here << '/' << group.size();
    }
    std::cout << ", right " << right << ", wrong " << wrong << ", loose " << loose
              << " of " << set.scans.size() << ", pairs " << joined.pairs_placed
              << " of " << joined.pairs_compared << ", " << spent.count() << " s\n";
    if (knobs["verbose"] > 0)
      for (const auto& group : joined.groups) {
        const std::size_t middle = middleOf(set, joined, group);
        for (const std::size_t i : group)
          if (group.size() == 1)
            std::cout << "  " << i << " loose: " << joined.scans[i].rejection << '\n';
          else if (!isRight(set, joined, middle, i))
            std::cout << "  " << i << " WRONG: at "
                      << (joined.scans[middle].T_group_scan.inverse() *
                          joined.scans[i].T_group_scan)
                             .translation()
                             .transpose()
                      << " instead of "
                      << (set.T_world_scan[middle].inverse() * set.T_world_scan[i])
                             .translation()
                             .transpose()
                      << '\n';
      }
    if (knobs["verbose"] > 0)
      for (const auto& group : joined.groups) {
        if (group.size() < 3)
          continue;
        std::deque<VerifiedScan> members;
        std::vector<std::string> names;
        std::vector<Eigen::Isometry3d> poses;
        for (const std::size_t i : group) {
          members.push_back(set.scans[i]);
          names.push_back(std::to_string(i));
          poses.push_back(joined.scans[i].T_group_scan);
        }
        const MapVerification map = MapVerifier(members, names).verify(poses);
        std::cout << "  verdict on " << group.size()
                  << " scans: " << toString(map.trust);
        for (const auto& doubt : map.doubts)
          std::cout << "; " << doubt;
        std::cout << '\n';
      }
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
