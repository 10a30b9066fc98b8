// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/global_registration/map_localiser.h>

#include <algorithm>
#include <utility>

namespace pcl6d {

namespace {
/** \return the scans of a map nearest to a position, the nearest first */
std::vector<KnownScan>
nearestOf(const std::vector<KnownScan>& map,
          const Eigen::Vector3d& position,
          std::size_t most)
{
  std::vector<KnownScan> nearest = map;
  std::stable_sort(
      nearest.begin(), nearest.end(), [&](const KnownScan& a, const KnownScan& b) {
        return (a.T_world_scan.translation() - position).squaredNorm() <
               (b.T_world_scan.translation() - position).squaredNorm();
      });
  nearest.resize(std::min(most, nearest.size()));
  return nearest;
}
} // namespace

void
MapLocaliserOptions::validate() const
{
  require(neighbours > 0, "neighbours", neighbours, "> 0");
  search.validate();
}

MapLocaliser::MapLocaliser(std::vector<KnownScan> map,
                           const MapLocaliserOptions& options)
: map_(std::move(map)), options_(options)
{
  options_.validate();
  require(!map_.empty(), "scans of the map", map_.size(), "> 0");
  options_.search.num_threads = options_.num_threads;
}

std::optional<LocalisedScan>
MapLocaliser::track(const PlaceableScan& scan,
                    const std::optional<Eigen::Isometry3d>& motion,
                    const std::vector<KnownScan>& map) const
{
  const std::vector<Eigen::Isometry3d> guesses = {
      exactlyRigid(*before_ * motion.value_or(motion_)), *before_};
  GuessOptions options;
  options.needs = PlaceNeeds::kConfirmed;
  options.num_threads = options_.num_threads;
  const GuessedPlace found =
      placeByGuesses(scan,
                     nearestOf(map, guesses[0].translation(), options_.neighbours),
                     guesses,
                     options);
  if (!found.accepted)
    return std::nullopt;
  return LocalisedScan{PlaceAnswer::kUnique,
                       found.T_world_scan,
                       true,
                       found.overlap,
                       found.contradiction,
                       {}};
}

LocalisedScan
MapLocaliser::search(const PlaceableScan& scan, const std::vector<KnownScan>& map) const
{
  const MapPlaces places = placeInMap(scan, map, options_.search);
  LocalisedScan found;
  found.answer = places.answer;
  found.rejection = places.rejection;
  if (places.candidates.empty()) {
    found.T_map_scan = before_.value_or(Eigen::Isometry3d::Identity());
    return found;
  }
  const MapPlace& best = places.candidates.front();
  found.T_map_scan = best.T_map_scan;
  found.overlap = best.overlap;
  found.contradiction = best.contradiction;
  return found;
}

LocalisedScan
MapLocaliser::localise(const PlaceableScan& scan,
                       const std::optional<Eigen::Isometry3d>& motion,
                       const std::set<std::size_t>& left_out)
{
  if (motion && !isRigid(*motion))
    throw BadArgument("the motion is not rigid");
  std::vector<KnownScan> map;
  for (std::size_t i = 0; i < map_.size(); ++i)
    if (left_out.count(i) == 0)
      map.push_back(map_[i]);
  require(!map.empty(), "scans of the map to compare with", map.size(), "> 0");
  std::optional<LocalisedScan> found;
  if (before_)
    found = track(scan, motion, map);
  if (!found)
    found = search(scan, map);
  if (found->answer != PlaceAnswer::kUnique) {
    before_.reset(); // the next scan is searched in the whole map
    motion_.setIdentity();
    return *found;
  }
  motion_ = before_ ? exactlyRigid(before_->inverse() * found->T_map_scan)
                    : Eigen::Isometry3d::Identity();
  before_ = found->T_map_scan;
  return *found;
}

} // namespace pcl6d
