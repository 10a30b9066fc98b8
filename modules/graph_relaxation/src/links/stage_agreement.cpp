// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/median.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/voxel_numbers.h>
#include <pcl6d/common/work_sharing.h>
#include <pcl6d/graph_relaxation/map_agreement.h>
#include <pcl6d/graph_relaxation/stage_agreement.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace pcl6d {

namespace {
/** [voxels] Largest distance of neighbours of points. */
constexpr double kNeighbourVoxels = 2;

/** [voxels] Size of the pieces of a scan's surface. */
constexpr double kPieceVoxels = 16;

/** Sampled points of a scan per pair of scans; fewer, down to the least number, if the total
 * exceeds the given limit. */
constexpr std::size_t kPointsOfPair = 400, kPointsOfAll = 4000000, kFewestOfPair = 50;

/** A scan is worse if its agreement fell by this number of deviations: by chance, less than one
 * scan in thousands does ... */
constexpr double kScanDeviations = 5;
/** ... and by this share of its agreement: smaller losses are normal when every scan moves and
 * the map improves. */
constexpr double kScanShare = 0.1;

/** In place of a distance: free space of the other scan, or no surface there. */
constexpr float kLookedThrough = -1, kNothingThere = -2;

/** \brief [m] from a point to the surface of another scan, at both poses. */
struct Distances {
  float before = kNothingThere;
  float after = kNothingThere;
};

/** \brief The points of one scan, transformed into the frame of another. */
struct View {
  std::size_t of = 0, in = 0; ///< scans
  std::vector<Distances> points;
};

/** \return the union of two sorted lists of pairs */
std::vector<ScanPair>
allOf(const std::vector<ScanPair>& some, const std::vector<ScanPair>& others)
{
  std::vector<ScanPair> all;
  std::set_union(some.begin(),
                 some.end(),
                 others.begin(),
                 others.end(),
                 std::back_inserter(all),
                 [](const ScanPair& a, const ScanPair& b) {
                   return a.second != b.second ? a.second < b.second
                                               : a.first < b.first;
                 });
  return all;
}

float
distanceToSurface(const IcpModel& model, std::size_t i, const Eigen::Vector3f& p)
{
  const Eigen::Vector3f d = p - model.points()[i];
  if (model.normals().empty() || model.normals()[i].isZero(0))
    return d.norm();
  return std::abs(model.normals()[i].dot(d));
}

/** \return for each stride-th point of a scan its distance to the surface of another */
std::vector<float>
distancesTo(const NetworkScan& other,
            const NetworkScan& scan,
            const Eigen::Isometry3d& T_other_scan,
            std::size_t stride,
            double voxel)
{
  const double reach = kNeighbourVoxels * voxel;
  const auto sigma = static_cast<float>(2.0 / 3 * agreementDistance(voxel));
  const Points& points = scan.model().points();
  std::vector<float> distances;
  Points alone;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    const Eigen::Vector3f p = (T_other_scan * points[i].cast<double>()).cast<float>();
    const Neighbour near =
        other.model().tree().nearest(p, static_cast<float>(reach * reach));
    if (near.index < 0) {
      alone.push_back(p);
      places.push_back(distances.size());
    }
    distances.push_back(
        near.index < 0 ? kNothingThere
                       : distanceToSurface(
                             other.model(), static_cast<std::size_t>(near.index), p));
  }
  const std::vector<SightOfPlace> seen = other.rays().look(alone, {sigma});
  for (std::size_t k = 0; k < alone.size(); ++k)
    if (seen[k].sight == Sight::kFree)
      distances[places[k]] = kLookedThrough;
  return distances;
}

std::size_t
pointsOfPair(std::size_t pairs)
{
  return std::clamp(
      kPointsOfAll / std::max<std::size_t>(1, 2 * pairs), kFewestOfPair, kPointsOfPair);
}

std::size_t
strideOf(const NetworkScan& scan, std::size_t wanted)
{
  return std::max<std::size_t>(1, scan.model().points().size() / wanted);
}

/** \brief The input of the stage test. */
struct Stage {
  const std::vector<NetworkScan>& scans;
  const Poses& before;
  const Poses& after;
  double voxel;
  std::size_t wanted; ///< points of a scan in another
};

View
viewOf(const Stage& stage, std::size_t of, std::size_t in)
{
  const NetworkScan& scan = stage.scans[of];
  const std::size_t stride = strideOf(scan, stage.wanted);
  const auto at = [&](const Poses& poses) {
    return distancesTo(
        stage.scans[in], scan, poses[in].inverse() * poses[of], stride, stage.voxel);
  };
  const std::vector<float> before = at(stage.before), after = at(stage.after);
  View view{of, in, {}};
  for (std::size_t i = 0; i < before.size(); ++i)
    view.points.push_back({before[i], after[i]});
  return view;
}

/** Ordered by the observing scan: its tree and rays then stay in the cache.
 * \return by owner of the points */
std::vector<std::vector<View>>
viewsOf(const Stage& stage,
        const std::vector<ScanPair>& pairs,
        unsigned int num_threads,
        WorkSharing* sharing)
{
  std::vector<std::vector<View>> asked(stage.scans.size());
  for (const auto& [a, b] : pairs) {
    asked[a].push_back({b, a, {}});
    asked[b].push_back({a, b, {}});
  }
  std::vector<std::vector<std::vector<Distances>>> answers(stage.scans.size());
  sharedFor(sharing, num_threads, answers, [&](std::size_t in) {
    for (const View& view : asked[in])
      answers[in].push_back(viewOf(stage, view.of, in).points);
  });
  std::vector<std::vector<View>> views(stage.scans.size());
  for (std::size_t in = 0; in < asked.size(); ++in)
    for (std::size_t k = 0; k < asked[in].size(); ++k) {
      View& view = asked[in][k];
      view.points = std::move(answers[in][k]);
      views[view.of].push_back(std::move(view));
    }
  return views;
}

/** \return [m] the robust standard deviation of points from surfaces, at the better poses */
double
deviationOf(const std::vector<std::vector<View>>& views)
{
  std::vector<double> before, after;
  for (const auto& of_scan : views)
    for (const View& view : of_scan)
      for (const Distances& point : view.points)
        if (point.before >= 0 && point.after >= 0) {
          before.push_back(point.before);
          after.push_back(point.after);
        }
  return 1.4826 *
         std::min(upperMedian(std::move(before)), upperMedian(std::move(after)));
}

double
scoreOf(float distance, double deviation)
{
  if (distance == kNothingThere)
    return 0;
  if (distance == kLookedThrough)
    return -1;
  const double share = distance / deviation;
  return 1 / (1 + share * share);
}

/** \brief Sums up the agreement of points, together for each cube of the world. */
class ChangeSums {
public:
  void
  add(VoxelKey cube, double before, double after)
  {
    const auto [number, is_new] = numbers_.add(cube);
    if (is_new)
      cubes_.emplace_back();
    ++cubes_[number].points;
    cubes_[number].gain += after - before;
    ++points_;
    before_ += before;
    after_ += after;
  }

  AgreementChange
  change() const
  {
    if (points_ == 0)
      return {};
    const auto count = static_cast<double>(points_);
    const double gain = (after_ - before_) / count;
    double squares = 0;
    for (const Cube& cube : cubes_) {
      const double beyond = cube.gain - gain * static_cast<double>(cube.points);
      squares += beyond * beyond;
    }
    return {before_ / count, after_ / count, std::sqrt(squares) / count};
  }

private:
  struct Cube {
    std::size_t points = 0;
    double gain = 0;
  };
  VoxelNumbers numbers_;
  std::vector<Cube> cubes_;
  std::size_t points_ = 0;
  double before_ = 0, after_ = 0;
};

/** \return the cube of a point, about an origin; one common cube for points beyond the grid */
VoxelKey
cubeOf(const Eigen::Vector3d& point, const Eigen::Vector3d& origin, double cube)
{
  constexpr double kReach = 1 << 19;
  const Eigen::Vector3d p = point - origin;
  if (!(p.cwiseAbs().maxCoeff() < kReach * cube))
    return std::numeric_limits<VoxelKey>::max();
  return voxelKey(p.cast<float>(), cube);
}

void
sumUp(const Stage& stage,
      const std::vector<std::vector<View>>& views,
      StageAgreement& agreement)
{
  const double deviation = // lower bound, for points exactly on surfaces
      std::max(agreement.deviation, 1e-6 * stage.voxel);
  const Eigen::Vector3d origin = stage.after.front().translation();
  ChangeSums all;
  for (std::size_t scan = 0; scan < views.size(); ++scan) {
    ChangeSums of_scan;
    const Points& points = stage.scans[scan].model().points();
    const std::size_t stride = strideOf(stage.scans[scan], stage.wanted);
    std::vector<VoxelKey> cubes;
    for (std::size_t i = 0; i < points.size() && !views[scan].empty(); i += stride)
      cubes.push_back(cubeOf(stage.after[scan] * points[i].cast<double>(),
                             origin,
                             agreementCube(stage.voxel)));
    for (const View& view : views[scan])
      for (std::size_t k = 0; k < view.points.size(); ++k) {
        const double before = scoreOf(view.points[k].before, deviation);
        const double after = scoreOf(view.points[k].after, deviation);
        of_scan.add(cubes[k], before, after);
        all.add(cubes[k], before, after);
      }
    agreement.scans.push_back(of_scan.change());
  }
  agreement.total = all.change();
}

Rejection
lossOf(RejectReason reason, const AgreementChange& change)
{
  Rejection lost(reason, change.after, change.before);
  lost.deviations = (change.before - change.after) / change.deviation;
  return lost;
}
} // namespace

double
agreementCube(double voxel)
{
  return kPieceVoxels * voxel;
}

Rejection
StageAgreement::worse(const std::vector<bool>& counted) const
{
  if (total.isLoss())
    return lossOf(RejectReason::kAgreementLost, total);
  for (std::size_t i = 0; i < scans.size(); ++i)
    if ((counted.empty() || counted[i]) && scans[i].isLoss(kScanDeviations) &&
        scans[i].before - scans[i].after > kScanShare * std::abs(scans[i].before)) {
      Rejection lost = lossOf(RejectReason::kScanAgreementLost, scans[i]);
      lost.text = std::to_string(i);
      return lost;
    }
  return {};
}

StageAgreement
compareStage(const std::vector<NetworkScan>& scans,
             const Poses& before,
             const Poses& after,
             double voxel,
             unsigned int num_threads,
             WorkSharing* sharing)
{
  require(before.size() == scans.size(), "poses before", before.size(), "one per scan");
  require(after.size() == scans.size(), "poses after", after.size(), "one per scan");
  const auto visibleAt = [&](const Poses& poses) {
    return visiblePairs(scans, poses, voxel, num_threads, sharing);
  };
  const std::vector<ScanPair> pairs = allOf(visibleAt(before), visibleAt(after));
  StageAgreement agreement;
  agreement.pairs = pairs.size();
  agreement.scans.reserve(scans.size());
  if (scans.empty())
    return agreement;
  const Stage stage{scans, before, after, voxel, pointsOfPair(pairs.size())};
  const std::vector<std::vector<View>> views =
      viewsOf(stage, pairs, num_threads, sharing);
  agreement.deviation = deviationOf(views);
  sumUp(stage, views, agreement);
  return agreement;
}

} // namespace pcl6d
