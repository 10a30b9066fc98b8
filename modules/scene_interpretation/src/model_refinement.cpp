// SPDX-License-Identifier: BSD-3-Clause
#include "manhattan_frames.h"
#include "plane_fit.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/scene_interpretation/interpretation.h>
#include <pcl6d/scene_interpretation/model_refinement.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pcl6d {
using namespace scene_interpretation;

namespace {
using Kind = ExactDirection::Kind;
std::string
rounded(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

class Refiner {
public:
  Refiner(const std::vector<PlaneSegment>& segments,
          const Points& points,
          const RefinementOptions& options)
  : segments_(segments)
  , points_(points)
  , options_(options)
  , planes_(segments.size())
  , directions_(segments.size())
  , alone_(segments.size(), false)
  {}

  RefinedModel
  run()
  {
    model_.planes = segments_;
    model_.points = points_;
    model_.changes.resize(segments_.size());
    fitAll();
    if (!findUp()) {
      model_.status = Status::kRankDeficient;
      return std::move(model_);
    }
    sortByKind();
    do {
      frames_ = gatherFrames(planes_, up_, options_.significance, alone_, directions_);
      optimiseFrames(planes_, directions_, options_.up.has_value(), frames_);
    } while (refuseWorst());
    model_.up = frames_.up;
    model_.headings = frames_.headings;
    parallelFor(segments_.size(), options_.num_threads, [&](std::size_t i) {
      if (directions_[i].kind != Kind::kFree)
        move(i);
    });
    return std::move(model_);
  }

private:
  bool
  takesPart(std::size_t plane) const
  {
    return segments_[plane].plane.label != toString(PlaneLabel::kNone) &&
           !segments_[plane].points.empty();
  }

  void
  fitAll()
  {
    is_plane_.assign(segments_.size(), 0);
    parallelFor(segments_.size(), options_.num_threads, [&](std::size_t i) {
      planes_[i] = fitted(segments_[i], points_);
      is_plane_[i] = takesPart(i) && fitNormal(options_, planes_[i]) ? 1 : 0;
    });
  }

  bool
  findUp()
  {
    constexpr double kMaxTilt = 0.7853981633974483; // [rad] 45 deg
    std::vector<Plane> planes;
    for (std::size_t i = 0; i < segments_.size(); ++i)
      if (is_plane_[i] != 0) {
        planes.push_back(segments_[i].plane);
        planes.back().normal = planes_[i].normal;
      }
    if (planes.empty())
      return false;
    const auto up = options_.up ? std::optional(options_.up->normalized())
                                : estimateUp(planes, options_.max_turn, kMaxTilt);
    up_ = up.value_or(Eigen::Vector3d::UnitZ());
    return up.has_value();
  }

  void
  sortByKind()
  {
    const SinCos limit = portableSinCos(options_.max_turn);
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      const double cosine = std::abs(planes_[i].normal.dot(up_));
      if (is_plane_[i] == 0)
        continue;
      if (cosine > limit.cos)
        directions_[i].kind = Kind::kUp;
      else if (cosine < limit.sin)
        directions_[i].kind = Kind::kAlong;
      else
        model_.changes[i].refusal = "neither level nor upright within " +
                                    rounded(options_.max_turn / kDegree) + " deg";
    }
  }

  Eigen::Vector3d
  exactNormal(std::size_t plane) const
  {
    const Eigen::Vector3d exact = frames_.normal(directions_[plane]);
    return exact.dot(planes_[plane].normal) < 0 ? Eigen::Vector3d(-exact) : exact;
  }

  double
  largestMove(std::size_t plane, const Eigen::Matrix3d& R) const
  {
    const Eigen::Vector3d& centre = planes_[plane].centroid;
    double largest = 0;
    for (const auto& corner : segments_[plane].plane.hull)
      largest = std::max(largest, (R * (corner - centre) - (corner - centre)).norm());
    return largest;
  }

  static Eigen::Matrix3d
  minimalRotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to)
  {
    return shortestRotation(from, to).toRotationMatrix();
  }

  // Factor by which a plane exceeds the limits of turn and move, with the reason.
  std::pair<double, std::string>
  objection(std::size_t plane) const
  {
    const Eigen::Vector3d exact = exactNormal(plane);
    const Turn turn = turnTo(planes_[plane], exact);
    const double move =
        largestMove(plane, minimalRotation(planes_[plane].normal, exact));
    const double allowed =
        std::min(options_.max_turn, options_.significance * turn.uncertainty);
    const double by_turn = allowed > 0 ? turn.angle / allowed : 0;
    const double by_move = move / options_.max_move;
    if (by_turn >= by_move)
      return {by_turn,
              "would turn by " + rounded(turn.angle / kDegree) + " deg, but at most " +
                  rounded(allowed / kDegree) + " deg is explained by its uncertainty"};
    return {by_move,
            "would move by " + rounded(move) + " m, but must at most by " +
                rounded(options_.max_move) + " m"};
  }

  // Takes out the plane that exceeds its limits most. \return false: every plane is
  // within its limits
  bool
  refuseWorst()
  {
    double worst = 1;
    std::size_t plane = segments_.size();
    std::string reason;
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      if (directions_[i].kind == Kind::kFree)
        continue;
      const auto [factor, words] = objection(i);
      if (factor > worst) {
        worst = factor;
        plane = i;
        reason = words;
      }
    }
    if (plane == segments_.size())
      return false;
    const bool is_level = directions_[plane].kind == Kind::kUp;
    if (is_level || alone_[plane])
      directions_[plane].kind = Kind::kFree;
    const char* const what = is_level        ? "not made horizontal: "
                             : alone_[plane] ? "not made vertical: "
                                             : "not made parallel to a frame: ";
    alone_[plane] = true;
    model_.changes[plane].refusal = what + reason;
    return true;
  }

  void
  move(std::size_t i)
  {
    const FittedPlane& fit = planes_[i];
    const Eigen::Vector3d exact = exactNormal(i);
    const Eigen::Matrix3d R = minimalRotation(fit.normal, exact);
    PlaneSegment& segment = model_.planes[i];
    PlaneChange& change = model_.changes[i];
    const Turn turn = turnTo(fit, exact);
    change.kind = directions_[i].kind == Kind::kUp ? RefinedKind::kHorizontal
                                                   : RefinedKind::kVertical;
    change.frame = directions_[i].kind == Kind::kUp ? 0 : directions_[i].frame;
    change.turn = turn.angle;
    change.uncertainty = turn.uncertainty;
    change.shift = fit.normal.dot(fit.centroid) - segment.plane.offset;
    change.largest_move = largestMove(i, R);
    for (const auto place : segment.points) {
      Eigen::Vector3d p = R * (points_[place].cast<double>() - fit.centroid);
      if (options_.project)
        p -= exact.dot(p) * exact;
      model_.points[place] = (fit.centroid + p).cast<float>();
    }
    const auto onPlane = [&](Eigen::Vector3d& corner) {
      const Eigen::Vector3d p = R * (corner - fit.centroid);
      corner = fit.centroid + p - exact.dot(p) * exact;
    };
    for (auto& corner : segment.plane.hull)
      onPlane(corner);
    for (auto& ring : segment.outline)
      for (auto& corner : ring)
        onPlane(corner);
    setPlane(exact, fit, segment);
  }

  void
  setPlane(const Eigen::Vector3d& exact, const FittedPlane& fit, PlaneSegment& segment)
  {
    Plane& plane = segment.plane;
    const bool was_ahead = segment.seen_from.dot(plane.normal) >= 0;
    plane.normal = exact;
    plane.offset = exact.dot(fit.centroid);
    plane.rms =
        options_.project
            ? 0
            : std::sqrt(std::max(fit.normal.dot(fit.scatter * fit.normal), 0.0) /
                        fit.points);
    segment.seen_from = was_ahead ? exact : Eigen::Vector3d(-exact);
    orientPlane(plane);
    if (plane.normal.dot(exact) < 0)
      for (auto& ring : segment.outline)
        std::reverse(ring.begin(), ring.end());
  }

  const std::vector<PlaneSegment>& segments_;
  const Points& points_;
  const RefinementOptions& options_;
  std::vector<FittedPlane> planes_;
  std::vector<char> is_plane_; // with a label, and fit to be turned
  std::vector<ExactDirection> directions_;
  std::vector<bool> alone_; // taken out of the frames
  Eigen::Vector3d up_ = Eigen::Vector3d::UnitZ();
  DirectionFrames frames_;
  RefinedModel model_;
};
} // namespace

void
RefinementOptions::validate() const
{
  constexpr double kEighth = 0.7853981633974483; // [rad] 45 deg
  if (up)
    require(up->allFinite() && up->norm() > 0, "up", up->transpose(), "no zero vector");
  require(max_turn > 0 && max_turn < kEighth, "max_turn", max_turn, "in (0, pi/4)");
  require(max_move > 0, "max_move", max_move, "> 0 [m]");
  require(significance > 0, "significance", significance, "> 0");
  require(map_angle_error >= 0, "map_angle_error", map_angle_error, ">= 0 [rad]");
  require(
      map_position_error >= 0, "map_position_error", map_position_error, ">= 0 [m]");
}

RefinedModel
refineModel(const std::vector<PlaneSegment>& segments,
            const Points& points,
            const RefinementOptions& options)
{
  options.validate();
  for (const auto& segment : segments)
    for (const auto place : segment.points)
      require(place < points.size(),
              "place of a point",
              place,
              "below the number of points, " + std::to_string(points.size()));
  return Refiner(segments, points, options).run();
}

} // namespace pcl6d
