// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/changes/changes_world.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/global_registration/place_run.h>
#include <pcl6d/verification/link_evidence.h>

#include <algorithm>
#include <cmath>
#include <deque>

namespace pcl6d::app {

namespace {
/** At most this number of scans of B is tested, evenly chosen, each with ... */
constexpr std::size_t kAsked = 24;
/** ... this number of scans of A, the nearest. */
constexpr std::size_t kLinksOfScan = 2;

/** \return [m] bounding box of the points of a run in its world */
Eigen::AlignedBox3d
boxOf(const ComparedRun& run)
{
  Eigen::AlignedBox3d box;
  for (const ComparedScan& scan : run)
    for (const auto& p : *scan.points)
      box.extend(scan.T_world_scan * p.cast<double>());
  return box;
}

/** \return pairs of near scans: indices in A and B */
std::vector<std::pair<std::size_t, std::size_t>>
askedPairs(const ComparedRun& a, const ComparedRun& b)
{
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  const std::size_t count = std::min(kAsked, b.size());
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t j = k * b.size() / count;
    std::vector<std::pair<double, std::size_t>> near;
    for (std::size_t i = 0; i < a.size(); ++i)
      near.emplace_back(
          (a[i].T_world_scan.translation() - b[j].T_world_scan.translation()).norm(),
          i);
    std::sort(near.begin(), near.end());
    for (std::size_t n = 0; n < std::min(kLinksOfScan, near.size()); ++n)
      pairs.emplace_back(near[n].second, j);
  }
  return pairs;
}

std::vector<LinkCheck>
linksOf(const ChangesSettings& s, const ComparedRuns& runs, const CommonWorld& world)
{
  const auto pairs = askedPairs(world.a, world.b);
  std::vector<LinkEvidence> evidence(pairs.size());
  parallelFor(pairs.size(), s.num_threads, [&](std::size_t k) {
    const auto [i, j] = pairs[k];
    evidence[k] =
        linkEvidence(runs.scan(0, i),
                     runs.scan(1, j),
                     world.a[i].T_world_scan.inverse() * world.b[j].T_world_scan);
  });
  const double background = contradictionBackground(evidence);
  std::vector<LinkCheck> links;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    links.push_back(linkCheck(pairs[k].first,
                              pairs[k].second,
                              evidence[k],
                              testLink(evidence[k], background)));
  return links;
}

/** Aligns the runs, and tests the links. */
void
settle(const ChangesSettings& s, const ComparedRuns& runs, CommonWorld& world)
{
  RunAlignmentOptions options;
  options.voxel = runs.voxel();
  options.move = world.source != "given";
  options.num_threads = s.num_threads;
  world.alignment = alignRuns(world.a, world.b, options);
  world.T_a_b = world.alignment.T_new_old * world.T_a_b;
  world.links = linksOf(s, runs, world);
  const std::size_t good =
      world.count(LinkTrust::kGood) + world.count(LinkTrust::kUnverified);
  const std::size_t wrong = world.count(LinkTrust::kWrong);
  if (good == 0 || wrong > good)
    world.doubt = std::to_string(wrong) + " of " + std::to_string(world.links.size()) +
                  " links between scans of both runs contradict the pose, and " +
                  std::to_string(good) + " confirm it";
}

void
move(const Eigen::Isometry3d& T_a_b, CommonWorld& world)
{
  world.T_a_b = T_a_b * world.T_a_b;
  for (ComparedScan& scan : world.b)
    scan.T_world_scan = T_a_b * scan.T_world_scan;
}

Eigen::Isometry3d
foundPlace(const ChangesSettings& s,
           const ComparedRuns& runs,
           const CommonWorld& world,
           const ProgressCallback& show)
{
  std::deque<PlaceableScan> scans;
  const auto known = [&](std::size_t run, const ComparedRun& compared) {
    std::vector<KnownScan> all;
    for (std::size_t i = 0; i < compared.size(); ++i) {
      scans.emplace_back(runs.scan(run, i));
      all.push_back({&scans.back(), compared[i].T_world_scan});
    }
    return all;
  };
  const auto a = known(0, world.a), b = known(1, world.b);
  RunPlaceOptions options;
  options.num_threads = s.num_threads;
  options.progress = show;
  const RunPlace place = placeRun(b, a, options);
  if (place.answer != PlaceAnswer::kUnique)
    throw ComputeFailed(s.run_b + ": does not meet " + s.run_a + ": " +
                        toWords(place.rejection) + "; nothing is compared");
  return place.T_map_run;
}

CommonWorld
asTheyAre(const ComparedRuns& runs)
{
  CommonWorld world;
  world.a = runs.compared(0);
  world.b = runs.compared(1);
  return world;
}

/** The motion in full coordinates. */
void
finish(const ComparedRuns& runs, CommonWorld& world)
{
  world.T_a_b = Eigen::Translation3d(runs.worldOffset()) * world.T_a_b *
                Eigen::Translation3d(-runs.worldOffset());
}
} // namespace

std::size_t
CommonWorld::count(LinkTrust trust) const
{
  return static_cast<std::size_t>(
      std::count_if(links.begin(), links.end(), [&](const LinkCheck& link) {
        return link.trust == trust;
      }));
}

CommonWorld
commonWorld(const ChangesSettings& s,
            const ComparedRuns& runs,
            const ProgressCallback& show)
{
  CommonWorld world = asTheyAre(runs);
  const auto copies = runs.copies();
  if (s.given)
    world.source = "given";
  else if (!copies.empty()) {
    world.source = "copies";
    const auto [i, j] = copies.front();
    move(world.a[i].T_world_scan * world.b[j].T_world_scan.inverse(), world);
  }
  else if (boxOf(world.a).intersects(boxOf(world.b)))
    world.source = "poses";
  if (!world.source.empty())
    settle(s, runs, world);
  if (world.source.empty() || (world.source == "poses" && !world.doubt.empty())) {
    world = asTheyAre(runs);
    world.source = "search";
    move(foundPlace(s, runs, world, show), world);
    settle(s, runs, world);
  }
  finish(runs, world);
  return world;
}

} // namespace pcl6d::app
