// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/mcl_errors.h"
#include "evaluate/mcl_evaluation.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/localisation/levelling.h>
#include <pcl6d/slam6d/auto_parameters.h>
#include <pcl6d/slam6d/scan_preparation.h>

#include <algorithm>

namespace pcl6d::app {

namespace {
/** \return the pose in the plan: x, y, yaw */
Eigen::Vector3d
planPoseOf(const Eigen::Isometry3d& T)
{
  return {T.translation().x(), T.translation().y(), eulerFromRotation(T.linear()).yaw};
}

/** \return the pose of a scan that stands at a place of the plan */
Eigen::Isometry3d
standing(const Eigen::Vector3d& plan_pose,
         double z,
         const Eigen::Matrix3d& R_level_scan)
{
  Eigen::Isometry3d T = planarPose(plan_pose.x(), plan_pose.y(), plan_pose.z());
  T.translation().z() = z;
  T.linear() *= R_level_scan;
  return T;
}

/** \return the frame of the map at its offset, as far as the poses tell it */
Eigen::Isometry3d
mapOfPoses(const MclMap& map, const Eigen::Vector2d& offset)
{
  Eigen::Isometry3d T_map_world(map.R_map_world);
  T_map_world.translation().head<2>() = -offset;
  return T_map_world;
}

/** Wheel odometry: it says nothing of roll and pitch. */
bool
isPlanar(const ScanFolder& folder)
{
  for (std::size_t i = 0; i < folder.size(); ++i) {
    const Eigen::Vector3d up = folder.initialPose(i).linear().row(2).transpose();
    if ((up - Eigen::Vector3d::UnitZ()).norm() > 1e-9)
      return false;
  }
  return true;
}

/** Reads the scans and makes a virtual scan of each. */
class ScanReader {
public:
  ScanReader(const MclSettings& settings,
             const ScanFolder& folder,
             const Eigen::Matrix3d& R_map_world)
  : settings_(settings)
  , folder_(folder)
  , R_map_world_(R_map_world)
  , poses_tell_level_(!settings.level_by_walls || !isPlanar(folder))
  {
    gate_ = deriveParameters(settings.gate, {folder.read(0).points});
  }

  const Slam6DParameters&
  gate() const
  {
    return gate_;
  }

  Points
  points(std::size_t i) const
  {
    return gateScan(folder_.read(i).points, folder_.file(i).string(), gate_);
  }

  MclScan
  scan(std::size_t i) const
  {
    const Points gated = points(i);
    MclScan scan;
    scan.index = folder_.index(i);
    scan.name = folder_.name(i);
    scan.odometry = folder_.initialPose(i);
    if (poses_tell_level_)
      scan.R_level_scan =
          levellingOf((R_map_world_ * scan.odometry.linear()).row(2).transpose());
    if (settings_.level_by_walls)
      scan.R_level_scan = levelByWalls(gated, scan.R_level_scan).R_level_source;
    scan.virtual_scan = virtualScan(gated, scan.R_level_scan);
    return scan;
  }

private:
  const MclSettings& settings_;
  const ScanFolder& folder_;
  Eigen::Matrix3d R_map_world_;
  bool poses_tell_level_;
  Slam6DParameters gate_;
};

/** \return false if a signal came in */
bool
readScans(const ScanReader& reader,
          std::size_t count,
          const MclSettings& s,
          ProgressBar& bar,
          const Interrupt& interrupt,
          MclEvaluation& e)
{
  constexpr std::size_t kTogether = 16; // between two looks at the signals
  e.scans.resize(count);
  for (std::size_t begin = 0; begin < count; begin += kTogether) {
    if (interrupt.requested())
      return false;
    const std::size_t end = std::min(begin + kTogether, count);
    parallelFor(end - begin, s.mcl.num_threads, [&](std::size_t i) {
      e.scans[begin + i] = reader.scan(begin + i);
    });
    bar.show({"reading", end, count});
  }
  return true;
}

void
localise(const MclSettings& s,
         const std::optional<Eigen::Vector3d>& start,
         ProgressBar& bar,
         MclEvaluation& e)
{
  MonteCarloLocalisation filter(e.map, start, s.mcl);
  for (std::size_t i = 0; i < e.scans.size(); ++i) {
    const MclScan& scan = e.scans[i];
    Eigen::Vector3d motion = Eigen::Vector3d::Zero();
    if (i > 0)
      motion = planarMotion(e.scans[i - 1].odometry.inverse() * scan.odometry,
                            e.scans[i - 1].R_level_scan,
                            scan.R_level_scan);
    e.estimates.push_back(filter.addScan(motion, scan.virtual_scan));
    bar.show({"localising", i + 1, e.scans.size()});
  }
  distrustShortStretches(e.estimates, s.mcl.min_stretch);
}

/** \return the heights of the scans above the first: each way that the odometry measures
 * climbs with the mean slope at its ends */
std::vector<double>
heightsOf(const std::vector<MclScan>& scans)
{
  std::vector<double> heights(1, 0);
  for (std::size_t i = 1; i < scans.size(); ++i) {
    const MclScan &a = scans[i - 1], &b = scans[i];
    const Eigen::Isometry3d motion = a.odometry.inverse() * b.odometry;
    const Eigen::Vector3d way = motion.translation();
    const double climb_a = (a.R_level_scan * way).z();
    const double climb_b = (b.R_level_scan * motion.linear().transpose() * way).z();
    heights.push_back(heights.back() + (climb_a + climb_b) / 2);
  }
  return heights;
}

/** Gives the localised scans their poses in space, and finds the world in the map unless
 * the poses told it: by the given start, or by the first trusted scan. */
void
placeScans(const MclSettings& s, MclEvaluation& e)
{
  std::size_t anchor = 0;
  if (s.start == MclStart::kAnywhere)
    while (anchor + 1 < e.scans.size() && !e.estimates[anchor].trusted())
      ++anchor;
  const std::vector<double> heights = heightsOf(e.scans);
  const MclScan& fixed = e.scans[anchor];
  double z = 0;
  if (s.start == MclStart::kPoses)
    z = (e.T_map_world * fixed.odometry).translation().z();
  for (std::size_t i = 0; i < e.scans.size(); ++i)
    e.scans[i].T_map_scan = standing(
        e.estimates[i].pose, z + heights[i] - heights[anchor], e.scans[i].R_level_scan);
  if (s.start == MclStart::kPoses)
    return;
  Eigen::Vector3d pose = e.estimates[anchor].pose;
  if (s.start == MclStart::kGiven) {
    pose = s.start_pose;
    pose.head<2>() -= e.map.offset();
  }
  e.T_map_world = standing(pose, z, fixed.R_level_scan) * fixed.odometry.inverse();
}

/** \return false if a signal came in */
bool
justify(const MclSettings& s,
        const ScanReader& reader,
        ProgressBar& bar,
        const Interrupt& interrupt,
        MclEvaluation& e)
{
  JustificationOptions options;
  options.icp.num_threads = s.mcl.num_threads;
  e.justification = justifyByIcp(
      e.map,
      e.estimates,
      [&](std::size_t i) {
        return JustificationScan{reader.points(i), e.scans[i].R_level_scan};
      },
      options,
      [&](std::size_t done, std::size_t total) {
        bar.show({"matching", done, total});
        return !interrupt.requested();
      });
  return !interrupt.requested();
}
} // namespace

std::size_t
MclEvaluation::numTrusted() const
{
  return static_cast<std::size_t>(
      std::count_if(estimates.begin(), estimates.end(), [](const auto& estimate) {
        return estimate.trusted();
      }));
}

std::vector<MclInterval>
MclEvaluation::doubtfulIntervals() const
{
  std::vector<MclInterval> intervals;
  bool goes_on = false;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const std::string reason = toString(estimates[i].doubt);
    if (!reason.empty() && goes_on && intervals.back().reason == reason)
      intervals.back().last = scans[i].index;
    else if (!reason.empty())
      intervals.push_back({scans[i].index, scans[i].index, reason});
    goes_on = !reason.empty();
  }
  return intervals;
}

std::optional<MclEvaluation>
evaluateMcl(const MclSettings& s, ProgressBar& bar, const Interrupt& interrupt)
{
  const MclMap map = readMclMap(s);
  const ScanFolder folder(s.folder, s.scans);
  if (!folder.hasPoses())
    throw IoFailed(s.folder +
                   ": no poses were found, but the odometry is needed to move "
                   "from scan to scan; give --poses");
  std::optional<Trajectory> reference;
  if (!s.reference.empty())
    reference = readMclReference(s.reference, folder);
  MclEvaluation e(map);
  e.pose_source = folder.poseSource();
  const ScanReader reader(s, folder, map.R_map_world);
  e.gate = reader.gate();
  e.stamps = folder.stamps();
  if (!readScans(reader, folder.size(), s, bar, interrupt, e))
    return std::nullopt;
  e.T_map_world = mapOfPoses(map, e.map.offset());
  std::optional<Eigen::Vector3d> start;
  if (s.start == MclStart::kPoses)
    start = planPoseOf(e.T_map_world * e.scans.front().odometry);
  if (s.start == MclStart::kGiven)
    start = s.start_pose - (Eigen::Vector3d() << e.map.offset(), 0).finished();
  localise(s, start, bar, e);
  placeScans(s, e);
  if (reference) {
    e.all = mclErrors(e, *reference, false);
    e.trusted = mclErrors(e, *reference, true);
  }
  if (s.justify && !justify(s, reader, bar, interrupt, e))
    return std::nullopt;
  return e;
}

} // namespace pcl6d::app
