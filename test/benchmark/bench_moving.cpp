// SPDX-License-Identifier: BSD-3-Clause
// Folders whose points tell by a field `dynamic` whether they moved: how many of each kind are
// told, by this suite and by two peers, and in what time.
// usage: bench_moving [threads=N] [peers=1] [scans=N] [each=1] FOLDER ...
#include "moving_peers.h"
#include "verification_links.h"

#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/moving_objects/moving_points.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <string>
#include <vector>

namespace pcl6d::bench {

namespace {
/** \return [s] of all threads */
double
processorSeconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/** Points of both kinds, and how many of them were told so. */
struct Score {
  std::size_t still = 0, still_told = 0, moving = 0, moving_told = 0;
  std::size_t known = 0, unseen_moving = 0;
  double worst_eaten = 0; ///< share of static points called dynamic, worst scan

  void
  add(const std::vector<char>& truth, const std::vector<PointMotion>& told)
  {
    std::size_t here = 0, eaten = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const bool moved = told[i] == PointMotion::kDynamic;
      known += told[i] != PointMotion::kUnknown ? 1 : 0;
      if (truth[i]) {
        ++moving;
        moving_told += moved ? 1 : 0;
        unseen_moving += told[i] == PointMotion::kUnknown ? 1 : 0;
      }
      else {
        ++here;
        eaten += moved ? 1 : 0;
      }
    }
    still += here;
    still_told += here - eaten;
    if (here > 0)
      worst_eaten =
          std::max(worst_eaten, static_cast<double>(eaten) / static_cast<double>(here));
  }

  void
  print(const char* name, double seconds, std::size_t points) const
  {
    const auto share = [](std::size_t part, std::size_t all) {
      return all == 0 ? 100.0
                      : 100.0 * static_cast<double>(part) / static_cast<double>(all);
    };
    const double sa = share(still_told, still), da = share(moving_told, moving);
    const double judged_da = share(moving_told, moving - unseen_moving);
    std::printf(
        "  %-10s SA %6.2f  DA %6.2f  AA %6.2f  (DA of those seen by others "
        "%6.2f, AA %6.2f; told %5.1f %%; worst scan %.2f %% eaten)  %.1f ms per "
        "100 000 points\n",
        name,
        sa,
        da,
        std::sqrt(sa * da),
        judged_da,
        std::sqrt(sa * judged_da),
        share(known, still + moving),
        100 * worst_eaten,
        1e3 * seconds * 1e5 / static_cast<double>(points));
  }
};

std::vector<std::vector<char>>
truthOf(const std::string& folder, std::size_t count, double nearest, double farthest)
{
  const ScanFolder scans(folder, {});
  std::vector<std::vector<char>> truth;
  for (std::size_t i = 0; i < std::min(count, scans.size()); ++i) {
    const Scan scan = scans.read(i);
    const auto field = fieldValues(scan.cloud, "dynamic");
    truth.emplace_back();
    for (std::size_t p = 0; p < scan.points.size(); ++p) {
      const float range = scan.points[p].norm(); // as readLinkSet() leaves out
      if (scan.points[p].allFinite() && range >= nearest && range <= farthest)
        truth.back().push_back(field && field->values[p] != 0 ? 1 : 0);
    }
  }
  return truth;
}

std::vector<SeenScan>
seen(const LinkSet& set)
{
  std::vector<SeenScan> scans;
  for (std::size_t i = 0; i < set.scans.size(); ++i) {
    const IcpModel& surfaces = set.scans[i].surfaces();
    SeenScan scan;
    scan.rays = &set.scans[i].rays();
    scan.surface = &surfaces.points();
    scan.normals = &surfaces.normals();
    scan.tree = &surfaces.tree();
    scan.voxel = set.voxel;
    scan.T_world_scan = set.T_world_scan[i];
    scans.push_back(scan);
  }
  return scans;
}

int
run(const std::vector<std::string>& arguments)
{
  std::map<std::string, int> knobs{
      {"threads", 2}, {"peers", 0}, {"scans", 1000}, {"each", 0}};
  for (const std::string& argument : arguments) {
    const auto equals = argument.find('=');
    if (equals != std::string::npos) {
      knobs.at(argument.substr(0, equals)) = std::atoi(argument.c_str() + equals + 1);
      continue;
    }
    LinkSet set = readLinkSet(argument, 1, static_cast<std::size_t>(knobs["scans"]));
    const auto truth =
        truthOf(argument, set.scans.size(), set.min_range, set.max_range);
    MovingPointsOptions options;
    options.num_threads = static_cast<unsigned int>(knobs["threads"]);
    const double start = processorSeconds();
    const MovingPoints moving(seen(set), options);
    Score score;
    std::size_t points = 0;
    std::vector<std::vector<PointMotion>> told;
    for (std::size_t i = 0; i < set.scans.size(); ++i) {
      told.push_back(moving.classify(i, set.measured[i]));
      points += set.measured[i].size();
    }
    const double spent = processorSeconds() - start;
    std::printf("%s: %zu scans, %zu points, voxel %.3f m\n",
                argument.c_str(),
                set.scans.size(),
                points,
                set.voxel);
    for (std::size_t i = 0; i < told.size(); ++i) {
      score.add(truth[i], told[i]);
      if (knobs["each"]) {
        Score one;
        one.add(truth[i], told[i]);
        std::printf("%3zu %zu dynamic", i, one.moving);
        one.print("", 0, 1);
      }
    }
    std::printf("  background %.3f\n", moving.background());
    score.print("ours", spent, points);
    if (knobs["peers"])
      for (const MovingPeer& peer : movingPeers()) {
        const double begun = processorSeconds();
        const auto by_peer = peer.evaluate(set.measured, set.T_world_scan);
        const double its = processorSeconds() - begun;
        Score theirs;
        for (std::size_t i = 0; i < by_peer.size(); ++i)
          theirs.add(truth[i], by_peer[i]);
        theirs.print(peer.name, its, points);
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
