// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "evidence_parts.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/verification/pose_mistake.h>

#include <algorithm>
#include <array>
#include <utility>

namespace pcl6d {
using namespace verification;

namespace {
/** Number of tested pairs of scans. */
constexpr std::size_t kAskedPairs = 6;

/** A change of the poses: a factor of the positions, and turned axes. */
struct PoseMistake {
  std::string words;
  double scale = 1;
  Eigen::Matrix3d axes =
      Eigen::Matrix3d::Identity(); ///< axes of the scans in terms of the poses' axes
};

/** "(y, -x, z)" */
std::string
axesText(const Eigen::Matrix3d& axes)
{
  std::string text = "(";
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      if (axes(row, column) != 0)
        text += std::string(row > 0 ? ", " : "") + (axes(row, column) < 0 ? "-" : "") +
                "xyz"[column];
  return text + ")";
}

void
addUnits(std::vector<PoseMistake>& mistakes)
{
  constexpr std::pair<const char*, double> kUnits[] = {{"feet", 0.3048},
                                                       {"inches", 0.0254},
                                                       {"centimetres", 0.01},
                                                       {"millimetres", 0.001}};
  for (const auto& [name, metres] : kUnits) {
    mistakes.push_back({std::string("positions are in ") + name + ", scans in metres",
                        metres,
                        Eigen::Matrix3d::Identity()});
    mistakes.push_back({std::string("scans are in ") + name + ", positions in metres",
                        1 / metres,
                        Eigen::Matrix3d::Identity()});
  }
}

/** The 47 other assignments of axes: half turns, then quarter turns, then mirrors. */
void
addAxes(std::vector<PoseMistake>& mistakes)
{
  std::vector<std::pair<int, PoseMistake>> found;
  std::array<int, 3> order = {0, 1, 2};
  do
    for (int signs = 0; signs < 8; ++signs) {
      Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
      for (int row = 0; row < 3; ++row)
        axes(row, order[static_cast<std::size_t>(row)]) =
            (signs >> row & 1) != 0 ? -1 : 1;
      if (axes.isIdentity(0))
        continue;
      const bool is_mirror = axes.determinant() < 0;
      found.push_back(
          {(is_mirror ? 10 : 0) + (axes.isDiagonal(0) ? 0 : 1),
           {(is_mirror
                 ? "scans are mirrored against the poses (left-handed "
                   "coordinates read as right-handed?): "
                 : "axes of the poses are turned against the axes of the scans: ") +
                std::string("x, y, z of the scans are ") + axesText(axes) +
                " of the poses",
            1,
            axes}});
    }
  while (std::next_permutation(order.begin(), order.end()));
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return a.first < b.first;
  });
  for (auto& [rank, mistake] : found)
    mistakes.push_back(std::move(mistake));
}

Eigen::Isometry3d
without(const PoseMistake& mistake, const Eigen::Isometry3d& T)
{
  Eigen::Isometry3d right = Eigen::Isometry3d::Identity();
  right.linear() = mistake.axes * T.linear() * mistake.axes.transpose();
  right.translation() = mistake.scale * mistake.axes * T.translation();
  return right;
}

/** \return whether rays confirm the pose found by the surface fit
 * \param[in] is_given the pose is that of the given poses; another one is confirmed only by surfaces
 * that leave no motion open: two views of a floor agree wherever they lie on it */
bool
agree(const VerifiedScan& first,
      const VerifiedScan& second,
      const Eigen::Isometry3d& T,
      bool is_given)
{
  const double voxel = std::max(first.voxel(), second.voxel());
  const SurfaceFit fit =
      settledFit(first, second, T, voxel, kProbedPoints, kSteps, false);
  if (fit.pairs == 0 || fit.displacement() > voxel || // surfaces do not fit here
      (!is_given && fit.open_directions > 0))
    return false;
  const SightEvidence sight = sightBothWays(first, second, T, voxel, fit);
  return sight.patches >= kLeastPatches && sight.confirmation() >= kLeastConfirmation &&
         probabilityOf(
             raysAgainst(sight.contradicted_patches,
                         sight.patches,
                         {kBackground, kLeastBackground, kBackgroundPrecision}),
             kEvenShare) < kWrongAbove / 2;
}

/** \return the later scans of the pairs of successive scans with the longest steps */
std::vector<std::size_t>
farthestSteps(const std::vector<Eigen::Isometry3d>& poses)
{
  std::vector<std::pair<double, std::size_t>> steps;
  for (std::size_t i = 1; i < poses.size(); ++i)
    steps.emplace_back(-distanceBetween(poses[i - 1], poses[i]).translation, i);
  std::sort(steps.begin(), steps.end());
  steps.resize(std::min(steps.size(), kAskedPairs));
  std::vector<std::size_t> scans;
  scans.reserve(steps.size());
  for (const auto& [distance, i] : steps)
    scans.push_back(i);
  return scans;
}
} // namespace

std::string
likelyPoseMistake(const std::deque<VerifiedScan>& scans,
                  const std::vector<Eigen::Isometry3d>& T_world_scan,
                  unsigned int num_threads)
{
  require(T_world_scan.size() == scans.size(),
          "poses",
          T_world_scan.size(),
          "one per scan");
  std::vector<PoseMistake> mistakes(1); // first: no mistake
  addUnits(mistakes);
  addAxes(mistakes);
  const std::vector<std::size_t> asked = farthestSteps(T_world_scan);
  std::vector<std::size_t> agreeing(mistakes.size(), 0);
  parallelFor(mistakes.size(), num_threads, [&](std::size_t m) {
    for (const std::size_t i : asked) {
      const Eigen::Isometry3d T =
          without(mistakes[m], T_world_scan[i - 1].inverse() * T_world_scan[i]);
      agreeing[m] += agree(scans[i - 1], scans[i], T, m == 0) ? 1 : 0;
    }
  });
  const auto best = static_cast<std::size_t>( // the first, simplest mistake among
                                              // equals
      std::max_element(agreeing.begin(), agreeing.end()) - agreeing.begin());
  if (best == 0 || agreeing[best] < 2 || 2 * agreeing[best] <= asked.size() ||
      2 * agreeing[0] > agreeing[best])
    return {};
  return mistakes[best].words + "? Then " + std::to_string(agreeing[best]) + " of " +
         std::to_string(asked.size()) +
         " pairs of scans would agree, with the given poses: " +
         std::to_string(agreeing[0]);
}

} // namespace pcl6d
