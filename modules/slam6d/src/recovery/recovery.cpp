// SPDX-License-Identifier: BSD-3-Clause
#include "recovery/motion_guesses.h"
#include "recovery/recovery.h"
#include "registered.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/global_registration/scan_joiner.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace pcl6d::slam6d {

namespace {
/** Number of scans that test a pose: the latest, and the nearest of the rest. */
constexpr std::size_t kLatest = 8, kNearest = 8;

/** Quick check of a match by the latest kLookedAt scans: above kSuspicious, the full test follows.
 * The limit lies between the values of right and wrong poses (contradictionOfPlace()); a needless
 * full test only costs time. */
constexpr std::size_t kLookedAt = 2;
constexpr double kSuspicious = 0.01;

/** Number of map links from which the background of contradictions at right poses is estimated, to
 * a third of its value. */
constexpr std::size_t kUsualLinks = 6;

/** Number of scans of a piece that are tested, evenly spaced. */
constexpr std::size_t kAskedOfPiece = 12;

/** Number of scans in a search without prediction, at about 10 ms per scan. */
constexpr std::size_t kLatestEverywhere = 24, kNearestEverywhere = 40;

/** Range of a search about the prediction, in deviations: 99.7 %. */
constexpr double kDeviations = 3;

/** Largest pair distance at the start of matching [voxels], equal to the default of a run. */
constexpr double kReachVoxels = 12;
} // namespace

bool
isBounded(const Slam6DOptions& options)
{
  return options.recovery == RecoveryEffort::kBounded;
}

bool
isLongSearchUseful(const RejectedMatch& match, RecoveryEffort effort)
{
  const bool is_right_as_others = match.is_unconfirmed && !match.is_contradicted &&
                                  match.is_expected && match.rays == RayTest::kFailed;
  return effort != RecoveryEffort::kBounded || !is_right_as_others;
}

Recovery::Recovery(const Slam6DOptions& options,
                   const std::deque<VerifiedScan>& verified)
: options_(options), verified_(verified)
{}

const PlaceableScan&
Recovery::placeable(std::size_t scan)
{
  if (placeable_.size() < verified_.size())
    placeable_.resize(verified_.size());
  if (!placeable_[scan])
    placeable_[scan].emplace(verified_[scan]);
  return *placeable_[scan];
}

/** \return indices of registered scans except this scan: the latest before, then the nearest */
std::vector<std::size_t>
Recovery::around(std::size_t scan,
                 const Eigen::Vector3d& position,
                 const std::vector<ScanResult>& scans,
                 std::size_t latest,
                 std::size_t nearest) const
{
  std::vector<std::size_t> chosen;
  for (std::size_t i = scan; i-- > 0 && chosen.size() < latest;)
    if (isRegistered(scans[i]))
      chosen.push_back(i);
  std::vector<std::pair<double, std::size_t>> others;
  for (std::size_t i = 0; i < scans.size() && nearest > 0; ++i)
    if (i != scan && isRegistered(scans[i]) &&
        std::find(chosen.begin(), chosen.end(), i) == chosen.end())
      others.emplace_back((scans[i].T_world_scan.translation() - position).norm(), i);
  std::sort(others.begin(), others.end());
  for (std::size_t k = 0; k < std::min(nearest, others.size()); ++k)
    chosen.push_back(others[k].second);
  return chosen;
}

std::vector<KnownScan>
Recovery::knownAround(std::size_t scan,
                      const Eigen::Vector3d& position,
                      const std::vector<ScanResult>& scans)
{
  std::vector<KnownScan> known;
  for (const std::size_t i : around(scan, position, scans, kLatest, kNearest))
    known.push_back({&placeable(i), scans[i].T_world_scan});
  return known;
}

/** \return the evidence of the latest links between consecutive scans, matched at their predicted
 * poses */
std::vector<LinkEvidence>
Recovery::usualBefore(std::size_t scan, const std::vector<ScanResult>& scans)
{
  std::vector<std::size_t> seconds;
  for (std::size_t i = scan; i-- > 1 && seconds.size() < kUsualLinks;)
    if (isRegistered(scans[i]) && isRegistered(scans[i - 1]) &&
        scans[i].recovered == RecoveredBy::kNone)
      seconds.push_back(i);
  usual_.resize(std::max(usual_.size(), scans.size()));
  parallelFor(seconds.size(), options_.num_threads, [&](std::size_t k) {
    const std::size_t i = seconds[k];
    const Eigen::Isometry3d T =
        scans[i - 1].T_world_scan.inverse() * scans[i].T_world_scan;
    if (!usual_[i] || usual_[i]->T_first_second.matrix() != T.matrix())
      usual_[i] = linkEvidence(verified_[i - 1], verified_[i], T);
  });
  std::vector<LinkEvidence> links;
  links.reserve(seconds.size());
  for (const std::size_t i : seconds)
    links.push_back(*usual_[i]);
  return links;
}

Rejection
Recovery::rejectionOf(std::size_t scan,
                      const Eigen::Isometry3d& T_world_scan,
                      const std::vector<ScanResult>& scans,
                      PlaceNeeds needs)
{
  return rejectionOfPose(placeable(scan),
                         knownAround(scan, T_world_scan.translation(), scans),
                         T_world_scan,
                         needs,
                         usualBefore(scan, scans),
                         options_.num_threads);
}

RayTest
Recovery::testRays(std::size_t scan, const std::vector<ScanResult>& scans)
{
  const auto usual = usualBefore(scan, scans);
  if (usual.empty())
    return RayTest::kUnproven;
  const double background = contradictionBackground(usual);
  const bool is_any_good =
      std::any_of(usual.begin(), usual.end(), [&](const LinkEvidence& link) {
        return testLink(link, background).trust == LinkTrust::kGood;
      });
  return is_any_good ? RayTest::kConfirming : RayTest::kFailed;
}

bool
Recovery::seemsContradicted(std::size_t scan,
                            const Eigen::Isometry3d& T_world_scan,
                            const std::vector<ScanResult>& scans)
{
  std::vector<KnownScan> last;
  for (const std::size_t i :
       around(scan, T_world_scan.translation(), scans, kLookedAt, 0))
    last.push_back({&placeable(i), scans[i].T_world_scan});
  return contradictionOfPlace(placeable(scan), last, T_world_scan) > kSuspicious;
}

/** \return options of guesses where the odometry leads \param[in] deviation [m] of the odometry */
GuessOptions
Recovery::guessOptions(std::size_t scan,
                       const std::vector<ScanResult>& scans,
                       double deviation)
{
  GuessOptions options;
  options.num_threads = options_.num_threads;
  options.usual = usualBefore(scan, scans);
  options.needs = PlaceNeeds::kConfirmed;
  options.reach =
      std::min(kDeviations * deviation, kReachVoxels * verified_[scan].voxel());
  return options;
}

Rejection
Recovery::whyUnconfirmable(std::size_t scan) const
{
  const VerifiedScan& one = verified_[scan];
  if (!one.abstains())
    return {};
  return one.isOffCentre() ? RejectReason::kOffCentre : RejectReason::kTooFewSurfaces;
}

std::optional<Recovery::Found>
Recovery::findByMotion(std::size_t scan, const std::vector<ScanResult>& scans)
{
  const auto way = motionSinceLast(scan, scans, verified_[scan].voxel());
  if (!way || whyUnconfirmable(scan))
    return std::nullopt;
  const GuessedPlace place =
      placeByGuesses(placeable(scan),
                     knownAround(scan, scans[scan].T_world_scan.translation(), scans),
                     posesByMotion(*way),
                     guessOptions(scan, scans, way->deviation));
  if (!place.accepted)
    return std::nullopt;
  return Found{place.T_world_scan,
               place.guess == 0 ? RecoveredBy::kSearch : RecoveredBy::kMotion};
}

std::optional<Recovery::Found>
Recovery::find(std::size_t scan, const std::vector<ScanResult>& scans)
{
  if (auto found = findByMotion(scan, scans))
    return found;
  const auto way = motionSinceLast(scan, scans, verified_[scan].voxel());
  if (!way || whyUnconfirmable(scan) || !isSearchDue(scan, scans, isBounded(options_)))
    return std::nullopt;
  GuessOptions options = guessOptions(scan, scans, way->deviation);
  options.needs = PlaceNeeds::kConnected;
  const double by = std::max(kDeviations * way->deviation, options.reach);
  const Eigen::Vector3d up = placeable(scan).vertical().up;
  std::vector<Eigen::Isometry3d> guesses =
      posesAround(way->T_world_last * way->odometry, up, by);
  const auto more = posesAround(way->T_world_last, up, by);
  guesses.insert(guesses.end(), more.begin(), more.end());
  const GuessedPlace place =
      placeByGuesses(placeable(scan),
                     knownAround(scan, scans[scan].T_world_scan.translation(), scans),
                     guesses,
                     options);
  if (place.accepted)
    return Found{place.T_world_scan, RecoveredBy::kSearch};
  return findEverywhere(scan, scans);
}

std::optional<Eigen::Isometry3d>
Recovery::findBefore(const std::vector<std::size_t>& piece,
                     const std::vector<ScanResult>& own,
                     const std::vector<ScanResult>& scans)
{
  const std::size_t last = piece.back();
  if (last + 1 >= scans.size() || !isRegistered(scans[last + 1]) ||
      whyUnconfirmable(last))
    return std::nullopt;
  const ScanResult& next = scans[last + 1];
  const Eigen::Isometry3d predicted =
      next.T_world_scan * next.initial_pose.inverse() * scans[last].initial_pose;
  const GuessOptions options =
      guessOptions(last, scans, deviationOfStep(scans, last, verified_[last].voxel()));
  const GuessedPlace found =
      placeByGuesses(placeable(last),
                     knownAround(last, predicted.translation(), scans),
                     {predicted},
                     options);
  if (!found.accepted)
    return std::nullopt;
  const Eigen::Isometry3d T_world_piece =
      found.T_world_scan * own[last].T_world_scan.inverse();
  const std::size_t asked = std::min(piece.size(), kAskedOfPiece);
  for (std::size_t k = 0; k < asked; ++k) {
    const std::size_t i = piece[k * piece.size() / asked];
    const Eigen::Isometry3d T = T_world_piece * own[i].T_world_scan;
    if (rejectionOfPose(placeable(i),
                        knownAround(i, T.translation(), scans),
                        T,
                        PlaceNeeds::kNoContradiction,
                        options.usual,
                        options_.num_threads))
      return std::nullopt;
  }
  return T_world_piece;
}

std::optional<Recovery::Found>
Recovery::findEverywhere(std::size_t scan, const std::vector<ScanResult>& scans)
{
  const auto others = around(scan,
                             scans[scan].T_world_scan.translation(),
                             scans,
                             kLatestEverywhere,
                             kNearestEverywhere);
  std::deque<PlaceableScan> list;
  JoinOptions join;
  for (const std::size_t i : others) {
    list.push_back(placeable(i));
    join.known.emplace_back(KnownPlace{0, scans[i].T_world_scan});
  }
  list.push_back(placeable(scan));
  join.known.emplace_back(std::nullopt);
  join.memory = &pairs_;
  join.num_threads = options_.num_threads;
  const JoinedScans joined = joinScans(list, join);
  const JoinedScan& placed = joined.scans.back();
  if (placed.group != joined.scans.front().group)
    return std::nullopt;
  return Found{placed.T_group_scan, RecoveredBy::kEverywhere};
}

} // namespace pcl6d::slam6d
