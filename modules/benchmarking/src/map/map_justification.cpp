// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/benchmarking/map_justification.h>
#include <pcl6d/benchmarking/trajectory_error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/filters/voxel_reduction.h>
#include <pcl6d/registration/icp_model.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>

namespace pcl6d {

namespace {
/** Target of the matching, and the selection of points. */
struct Method {
  const char* name;
  bool has_metascan;
  bool has_ground;
};

constexpr Method kMethods[] = {{"map", false, true},
                               {"metascan + map", true, true},
                               {"map, no ground", false, false}};

/** Matching of the scans by one method. */
class Matching {
public:
  Matching(const Method& method,
           const IcpModel& walls,
           const JustificationOptions& options)
  : method_(method), walls_(walls), options_(options)
  {}

  void
  add(const Eigen::Isometry3d& T_map_scan, const JustificationScan& scan)
  {
    ReductionOptions reduction;
    reduction.voxel = options_.voxel;
    const Points reduced =
        reducePoints(method_.has_ground ? scan.points
                                        : withoutGround(scan.points, scan.R_level_scan),
                     reduction);
    const auto model = std::make_shared<const IcpModel>(reduced, IcpModel::Options());
    IcpTarget target{walls_.part()};
    for (const auto& [other, pose] : metascan_)
      target.push_back(other->part(pose));
    const IcpResult result = icp(target, model->source(), T_map_scan, options_.icp);
    if (result.stop == IcpStop::kTooFewPairs || result.stop == IcpStop::kDiverged) {
      ++failed_;
      return;
    }
    errors_.push_back(poseError(result.T_target_source, T_map_scan));
    if (!method_.has_metascan)
      return;
    metascan_.emplace_back(model, result.T_target_source);
    if (metascan_.size() > options_.metascan)
      metascan_.pop_front();
  }

  JustificationRow
  row() const
  {
    std::vector<double> positions, yaws;
    for (const auto& error : errors_) {
      positions.push_back(error.position_2d);
      yaws.push_back(error.yaw);
    }
    return {method_.name, errorStatistics(positions), errorStatistics(yaws), failed_};
  }

private:
  Method method_;
  const IcpModel& walls_;
  const JustificationOptions& options_;
  std::deque<std::pair<std::shared_ptr<const IcpModel>, Eigen::Isometry3d>> metascan_;
  std::vector<PoseError> errors_;
  std::size_t failed_ = 0;
};

/** \return the pose of a localised scan, its ground at height 0 */
Eigen::Isometry3d
poseOf(const MclEstimate& estimate, const JustificationScan& scan)
{
  const double ground = virtualScan(scan.points, scan.R_level_scan).ground;
  Eigen::Isometry3d T =
      planarPose(estimate.pose.x(), estimate.pose.y(), estimate.pose.z());
  T.translation().z() = std::isnan(ground) ? 0 : -ground;
  T.linear() *= scan.R_level_scan;
  return T;
}
} // namespace

void
JustificationOptions::validate() const
{
  const auto isLength = [](double value) { return std::isfinite(value) && value > 0; };
  require(std::isfinite(low), "low", low, "finite");
  require(std::isfinite(high) && high > low, "high", high, "finite and > low");
  require(isLength(spacing), "spacing", spacing, "finite and > 0");
  require(isLength(voxel), "voxel", voxel, "finite and > 0");
  require(metascan > 0, "metascan", metascan, "> 0");
  icp.validate();
}

namespace {
/** \throws BadArgument the walls would be more points than a scan is matched with */
void
requireFewPoints(const SegmentMap& map, const JustificationOptions& options)
{
  constexpr double kMost = 2e7; // 240 MB
  double length = 0;
  for (const auto& wall : map.segments())
    length += (wall.b - wall.a).norm();
  const double area =
      (length + options.spacing) * (options.high - options.low + options.spacing);
  require(area <= kMost * options.spacing * options.spacing,
          "spacing",
          options.spacing,
          "larger: the plan has " + std::to_string(length) + " m of walls");
}
} // namespace

Points
extruded(const SegmentMap& map, const JustificationOptions& options)
{
  options.validate();
  const auto steps = [&](double length) {
    return std::max(1L, std::lround(length / options.spacing));
  };
  const long levels = steps(options.high - options.low);
  requireFewPoints(map, options);
  Points points;
  for (const auto& wall : map.segments()) {
    const long places = steps((wall.b - wall.a).norm());
    for (long i = 0; i <= places; ++i) {
      const Eigen::Vector2d foot = wall.a + static_cast<double>(i) /
                                                static_cast<double>(places) *
                                                (wall.b - wall.a);
      for (long k = 0; k <= levels; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(levels);
        const double z = options.low + share * (options.high - options.low);
        points.push_back(Eigen::Vector3d(foot.x(), foot.y(), z).cast<float>());
      }
    }
  }
  return points;
}

std::vector<JustificationRow>
justifyByIcp(const SegmentMap& map,
             const std::vector<MclEstimate>& estimates,
             const std::function<JustificationScan(std::size_t)>& scan,
             const JustificationOptions& options,
             const std::function<bool(std::size_t, std::size_t)>& goOn)
{
  const IcpModel walls(extruded(map, options), IcpModel::Options());
  std::vector<Matching> matchings;
  for (const Method& method : kMethods)
    matchings.emplace_back(method, walls, options);
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    if (goOn && !goOn(i, estimates.size()))
      return {};
    if (!estimates[i].trusted())
      continue;
    const JustificationScan current = scan(i);
    const Eigen::Isometry3d T_map_scan = poseOf(estimates[i], current);
    for (auto& matching : matchings)
      matching.add(T_map_scan, current);
  }
  std::vector<JustificationRow> rows;
  for (const auto& matching : matchings)
    rows.push_back(matching.row());
  return rows;
}

} // namespace pcl6d
