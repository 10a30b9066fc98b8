// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/angle.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/global_registration/place_in_map.h>
#include <pcl6d/global_registration/place_run.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
/** [voxels] Largest difference of agreeing poses: the error of matching (a third of a voxel), and
 * the deformation of the run and of the map. */
constexpr double kAgreeVoxels = 6;
constexpr double kAgreeTurn = radians(3.0);

/** Additional poses that must agree if contradictions remain, for example by changes: by chance
 * alone, two of eight poses agree in one of a hundred sites. */
constexpr std::size_t kMoreOfDoubted = 1;

/** A pose of the run supported by several scans. */
struct World {
  Eigen::Isometry3d T_map_run;
  std::size_t scans = 1; ///< scans with this best pose
  std::size_t sure = 0;  ///< number of them that are unique, without a contradiction

  bool
  isEnough(std::size_t enough) const
  {
    return sure >= enough || scans >= enough + kMoreOfDoubted;
  }
};

/** Adds the result of a scan. */
void
vote(const Eigen::Isometry3d& T_map_run,
     bool is_sure,
     const Eigen::Vector3d& centre,
     double reach,
     std::vector<World>& worlds)
{
  for (World& world : worlds) {
    const double off = (world.T_map_run * centre - T_map_run * centre).norm();
    const double turn = distanceBetween(world.T_map_run, T_map_run).rotation;
    if (off > reach || turn > kAgreeTurn)
      continue;
    ++world.scans;
    world.sure += is_sure ? 1 : 0;
    return;
  }
  worlds.push_back({T_map_run, 1, is_sure ? std::size_t{1} : 0});
}

/** \return indices of scans, evenly through a run, distant ones first: halves,
 * quarters, eighths of the way */
std::vector<std::size_t>
orderOf(std::size_t size, std::size_t tries)
{
  const std::size_t count = std::min(size, tries);
  std::vector<std::size_t> even;
  for (std::size_t k = 0; k < count; ++k)
    even.push_back((2 * k + 1) * size / (2 * count));
  std::vector<std::size_t> order;
  for (std::size_t stride = count; stride > 0; stride /= 2)
    for (std::size_t k = stride / 2; k < count; k += stride)
      if (std::find(order.begin(), order.end(), even[k]) == order.end())
        order.push_back(even[k]);
  return order;
}

RunPlace
answerOf(std::vector<World> worlds,
         std::size_t tried,
         std::size_t enough,
         const Rejection& reason)
{
  RunPlace place;
  place.tried = tried;
  std::stable_sort(worlds.begin(), worlds.end(), [](const World& a, const World& b) {
    return a.scans > b.scans;
  });
  // A run of few scans cannot have more that agree; one unique pose is enough.
  const bool is_one =
      !worlds.empty() && (worlds[0].isEnough(enough) || worlds[0].sure > 0);
  if (!is_one) {
    place.rejection = Rejection(RejectReason::kRunWithoutPose, reason);
    place.rejection.measured = static_cast<double>(tried);
    return place;
  }
  place.agreeing = worlds[0].scans;
  if (worlds.size() > 1 && worlds[1].scans == worlds[0].scans) {
    place.answer = PlaceAnswer::kAmbiguous;
    place.rejection = {RejectReason::kRunContradictory, static_cast<double>(tried)};
    return place;
  }
  place.answer = PlaceAnswer::kUnique;
  place.T_map_run = worlds[0].T_map_run;
  return place;
}
} // namespace

void
RunPlaceOptions::validate() const
{
  require(tries > 0, "tries", tries, "> 0");
  require(enough > 0, "enough", enough, "> 0");
  require(max_ambiguity >= 0 && max_ambiguity <= 1,
          "max_ambiguity",
          max_ambiguity,
          "in [0, 1]");
}

RunPlace
placeRun(const std::vector<KnownScan>& run,
         const std::vector<KnownScan>& map,
         const RunPlaceOptions& options)
{
  options.validate();
  require(!run.empty(), "scans of the run", run.size(), "> 0");
  for (const KnownScan& one : run)
    if (!isRigid(one.T_world_scan))
      throw BadArgument("a pose of the run is not a rigid motion");
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const KnownScan& one : run)
    centre += one.T_world_scan.translation() / static_cast<double>(run.size());
  MapPlaceOptions search;
  search.max_ambiguity = options.max_ambiguity;
  search.num_threads = options.num_threads;
  std::vector<World> worlds;
  Rejection reason;
  std::size_t tried = 0;
  const auto order = orderOf(run.size(), options.tries);
  if (options.progress)
    search.progress = [&](const Progress&) {
      options.progress({"placing the run", tried, order.size()});
    };
  for (const std::size_t i : order) {
    const MapPlaces found = placeInMap(*run[i].scan, map, search);
    ++tried;
    const bool is_sure = found.answer == PlaceAnswer::kUnique;
    if (!is_sure)
      reason = found.rejection;
    if (found.candidates.empty() || found.ambiguity() > options.max_ambiguity)
      continue;
    vote(found.candidates.front().T_map_scan * run[i].T_world_scan.inverse(),
         is_sure,
         centre,
         kAgreeVoxels * run[i].scan->scan().voxel(),
         worlds);
    if (std::any_of(worlds.begin(), worlds.end(), [&](const World& world) {
          return world.isEnough(options.enough);
        }))
      break;
  }
  return answerOf(std::move(worlds), tried, options.enough, reason);
}

} // namespace pcl6d
