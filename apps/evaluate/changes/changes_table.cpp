// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/changes/changes_report.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/io/text.h>

#include <algorithm>
#include <cstdio>

namespace pcl6d::app {

namespace {
std::string
sourceWords(const std::string& source)
{
  return source == "given"    ? "given poses of both runs"
         : source == "poses"  ? "given poses, confirmed by links"
         : source == "copies" ? "by scans in both runs"
                              : "placed without a guess";
}

/** Further remarks on a change. */
std::string
remarkOn(const Change& change)
{
  char text[160] = "";
  if (change.kind == ChangeKind::kMoved)
    std::snprintf(text,
                  sizeof text,
                  "by %.2f m, turned by %.0f deg; %.0f %% of its points meet",
                  (change.box.T_world_box.translation() -
                   change.before->T_world_box.translation())
                      .norm(),
                  degrees(rotationAngle(change.motion.linear())),
                  100 * change.agreement);
  else if (change.kind == ChangeKind::kSurface)
    std::snprintf(text,
                  sizeof text,
                  "%.3f m %s (noise: %.3f m)",
                  std::abs(change.distance),
                  change.distance > 0 ? "nearer" : "farther",
                  change.lod);
  else
    std::snprintf(text,
                  sizeof text,
                  "seen through by %s",
                  text::counted(change.num_observers, "scan").c_str());
  return text;
}

void
printRows(const ChangesReport& report)
{
  const auto& changes = report.found.changes;
  const std::size_t rows = std::min(changes.size(), report.settings.rows);
  if (rows > 0)
    std::printf("%-9s %8s %8s %8s   %-20s %8s %7s\n",
                "what",
                "x [m]",
                "y [m]",
                "z [m]",
                "size [m]",
                "sure",
                "voxels");
  for (std::size_t i = 0; i < rows; ++i) {
    const Change& one = changes[i];
    const Eigen::Vector3d place =
        report.runs.worldOffset() + one.box.T_world_box.translation();
    char size[60];
    std::snprintf(size,
                  sizeof size,
                  "%.2f x %.2f x %.2f",
                  one.box.size.x(),
                  one.box.size.y(),
                  one.box.size.z());
    std::printf("%-9s %8.2f %8.2f %8.2f   %-20s %7.2f%% %7zu  %s\n",
                toString(one.kind),
                place.x(),
                place.y(),
                place.z(),
                size,
                100 * one.confidence,
                one.points.size(),
                remarkOn(one).c_str());
  }
  if (changes.size() > rows)
    std::printf("and %zu more\n", changes.size() - rows);
}

void
printTally(const char* name, const std::string& run, const RunTally& tally)
{
  const auto share = [&](std::size_t count) {
    return tally.points == 0
               ? 0
               : 100 * static_cast<double>(count) / static_cast<double>(tally.points);
  };
  std::printf(
      "%s %s: %.2f %% as in the other, %.2f %% shifted, %.2f %% in changes, %.2f %% "
      "more seen through, %.2f %% moving by itself, %.1f %% not seen\n",
      name,
      run.c_str(),
      share(tally.there),
      share(tally.shifted),
      share(tally.changed),
      share(tally.seen_through - tally.changed),
      share(tally.restless),
      share(tally.unknown));
}
} // namespace

void
printChanges(const ChangesReport& report)
{
  const CommonWorld& world = report.world;
  std::printf(
      "%s on %s: %s; moved by %.3f m and %.2f deg, %.0f %% meet, %.3f m apart, "
      "scans bent by %.3f m; links: %zu good, %zu weak, %zu unverified, %zu wrong\n",
      report.settings.run_b.c_str(),
      report.settings.run_a.c_str(),
      sourceWords(world.source).c_str(),
      world.alignment.T_new_old.translation().norm(),
      degrees(rotationAngle(world.alignment.T_new_old.linear())),
      100 * world.alignment.overlap,
      world.alignment.residual,
      world.alignment.bending,
      world.count(LinkTrust::kGood),
      world.count(LinkTrust::kWeak),
      world.count(LinkTrust::kUnverified),
      world.count(LinkTrust::kWrong));
  if (!world.doubt.empty())
    return;
  printRows(report);
  if (!report.settings.quiet) {
    printTally("A", report.settings.run_a, report.found.first);
    printTally("B", report.settings.run_b, report.found.second);
  }
  const auto count = [&](ChangeKind kind) {
    return static_cast<std::size_t>(
        std::count_if(report.found.changes.begin(),
                      report.found.changes.end(),
                      [&](const Change& one) { return one.kind == kind; }));
  };
  std::printf("%zu moved, %zu appeared, %zu vanished, %zu shifted\n",
              count(ChangeKind::kMoved),
              count(ChangeKind::kAppeared),
              count(ChangeKind::kVanished),
              count(ChangeKind::kSurface));
  std::fflush(stdout);
}

} // namespace pcl6d::app
