// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/trajectory/trajectory_report.h"

#include <pcl6d/common/angle.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pcl6d::app {

namespace {
void
printHead(const std::string& title, const char* last)
{
  std::printf("\n%-20s%12s%12s%12s%12s%12s\n",
              title.c_str(),
              "rms",
              "mean",
              "median",
              "max",
              last);
}

void
printRow(const char* what,
         const ErrorStatistics& errors,
         double unit,
         std::size_t place)
{
  std::printf("  %-18s%12.4f%12.4f%12.4f%12.4f%12zu\n",
              what,
              unit * errors.rms,
              unit * errors.mean,
              unit * errors.median,
              unit * errors.max,
              place);
}

void
printErrors(const std::string& title,
            const TrajectoryErrors& errors,
            const TrajectoryEvaluation& evaluation)
{
  const auto row = [&](const char* what, const ErrorStatistics& kind, double unit) {
    printRow(what, kind, unit, evaluation.matching.pairs[kind.index_of_max].estimate);
  };
  printHead(title, "max at pose");
  row("position [m]", errors.position, 1);
  row("orientation [deg]", errors.orientation, degrees(1));
  row("2D position [m]", errors.position_2d, 1);
  row("yaw [deg]", errors.yaw, degrees(1));
  if (evaluation.path_length > 0)
    std::printf("  position rms is %.2f %% of the path\n",
                100 * errors.position.rms / evaluation.path_length);
}

/** max at pose: where the motion ends. */
void
printMotions(const std::string& title,
             const RelativeErrors& errors,
             const PoseMatching& matching)
{
  const auto end = [&](const ErrorStatistics& kind) {
    return matching.pairs[errors.motions[kind.index_of_max].to].estimate;
  };
  printHead(title, "max at pose");
  printRow("translation [m]", errors.translation, 1, end(errors.translation));
  printRow("rotation [deg]", errors.rotation, degrees(1), end(errors.rotation));
}

void
printDrift(const DriftErrors& drift)
{
  std::printf("\n%-20s%12s%12s%12s%12s\n",
              "per distance (RPE)",
              "rms [m]",
              "drift [%]",
              "[deg/m]",
              "stretches");
  for (const auto& one : drift.lengths)
    if (!one.errors.motions.empty())
      std::printf("  %15.5g m%14.4f%12.4f%12.5f%12zu\n",
                  one.length,
                  one.errors.translation.rms,
                  100 * one.translation_per_metre,
                  degrees(one.rotation_per_metre),
                  one.errors.motions.size());
  if (drift.stretches > 0)
    std::printf("  %-18s%12s%12.4f%12.5f%12zu\n",
                "all",
                "",
                100 * drift.translation_per_metre,
                degrees(drift.rotation_per_metre),
                drift.stretches);
  else
    std::printf("  no stretch is shorter than the path of %.2f m\n", drift.path);
}
} // namespace

void
printTable(const TrajectoryReport& report)
{
  const TrajectoryEvaluation& evaluation = report.evaluation;
  const auto& matching = evaluation.matching;
  std::printf("%s against %s\n"
              "%zu pairs of poses by %s, path %.2f m",
              report.estimate.c_str(),
              report.reference.c_str(),
              matching.pairs.size(),
              matching.by_time ? "time" : "index",
              evaluation.path_length);
  if (matching.unmatched_estimate + matching.unmatched_reference > 0)
    std::printf("; without partner: %zu of the estimate, %zu of the reference",
                matching.unmatched_estimate,
                matching.unmatched_reference);
  if (matching.untrusted > 0)
    std::printf("; left out for a doubtful reference: %zu", matching.untrusted);
  std::printf("\n");
  printErrors("without alignment", evaluation.without_alignment, evaluation);
  printErrors("with alignment (ATE)", evaluation.with_alignment, evaluation);
  if (evaluation.alignment.status != Status::kOk)
    std::printf("  only shifted: the positions do not determine a rotation (%s)\n",
                toString(evaluation.alignment.status));
  if (!evaluation.steps.motions.empty())
    printMotions("per step (RPE)", evaluation.steps, matching);
  printDrift(evaluation.drift);
  if (evaluation.loops.motions.empty())
    std::printf("\nno loop: the reference comes back to no place\n");
  else
    printMotions("loop closure, " + std::to_string(evaluation.loops.motions.size()),
                 evaluation.loops,
                 matching);
  const auto& ratios = evaluation.length_ratios;
  if (ratios.ratio.count > 0)
    std::printf(
        "\nlength ratios are off by %.3f %% rms, %.3f %% at most (scale %.5f)\n",
        100 * ratios.ratio.rms,
        100 * ratios.ratio.max,
        ratios.scale);
}

} // namespace pcl6d::app
