// SPDX-License-Identifier: BSD-3-Clause
#include "facing_surface.h"

#include <pcl6d/object_localization/pose_check.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
constexpr double kSameSide = 0.5; // cosine of 60 deg
constexpr float kSmooth = 0.94F;  // cosine of 20 deg
/** A ray may meet an element within so many of its sizes, and certainly does closer. */
constexpr double kRayWidth = 0.75;
constexpr double kRayCore = 0.4;
/** The next ray is not farther away than so many spacings. */
constexpr double kNextRay = 2;
/** Ranges differ by more than so many tolerances if they are of two surfaces. */
constexpr double kApart = 2;

/** Sorts the elements of an object by what the scan's rays through them say. */
class RayCheck {
public:
  RayCheck(const LocalizationScene& scene,
           const SceneSurface& surface,
           const ModelSurface& model,
           const Eigen::Isometry3d& T_scene_model,
           double tolerance)
  : scene_(scene)
  , surface_(surface)
  , model_(model)
  , T_model_scene_(T_scene_model.inverse())
  , element_(model.element)
  , tolerance_(tolerance)
  {}

  void
  add(const FacingElement& e)
  {
    ++check_.elements;
    const auto width = static_cast<float>(kRayWidth * element_ / e.range);
    const auto rays = surface_.directions.withinRadius(
        (e.point / e.range).cast<float>(), width * width, kMostRays);
    if (rays.empty())
      return addUnmet(e);
    const auto core = static_cast<float>(kRayCore * element_ / e.range);
    double nearest = INFINITY, farthest = 0;
    for (const Neighbour& ray : rays) {
      const auto i = static_cast<std::size_t>(ray.index);
      if (supports(e, i))
        return;
      if (ray.distance_sq > core * core)
        continue;
      const double range = surface_.elements.points[i].cast<double>().norm();
      nearest = std::min(nearest, range);
      farthest = std::max(farthest, range);
    }
    if (farthest > 0)
      addUnsupported(e, nearest, farthest);
  }

  PoseCheck
  result() &&
  {
    if (check_.supported > 0)
      check_.rms = std::sqrt(squares_ / static_cast<double>(check_.supported));
    auto& support = check_.support;
    std::sort(support.begin(), support.end());
    support.erase(std::unique(support.begin(), support.end()), support.end());
    return std::move(check_);
  }

private:
  static constexpr std::size_t kMostRays = 4;

  bool
  supports(const FacingElement& e, std::size_t i)
  {
    const auto& surfels = surface_.cloud.surfels();
    const Eigen::Vector3d normal = surfels.normals[i].cast<double>();
    const Eigen::Vector3d way = surface_.elements.points[i].cast<double>() - e.point;
    double distance = std::abs(e.normal.dot(way));
    if (surfels.smooth[i])
      distance = std::min(distance, std::abs(normal.dot(way)));
    const bool is_turned = surfels.smooth[i] && normal.dot(e.normal) < kSameSide;
    if (surface_.large[i] || is_turned || distance > tolerance_ + surface_.noise[i])
      return false;
    ++check_.supported;
    squares_ += distance * distance;
    check_.support.push_back(static_cast<std::uint32_t>(i));
    return true;
  }

  /** Of an element that rays met elsewhere. */
  void
  addUnsupported(const FacingElement& e, double nearest, double farthest)
  {
    const double margin = kApart * tolerance_ / e.cosine;
    if (nearest > e.range + margin)
      ++check_.refuted;
    else if (farthest < e.range - margin)
      ++check_.occluded;
    else
      ++check_.misfit;
  }

  /** Where no ray met the element: was there none, is something in front, or are rays
   * so far apart? */
  void
  addUnmet(const FacingElement& e)
  {
    const auto spacing = static_cast<float>(kNextRay * scene_.angularSpacing());
    const Neighbour ray = surface_.directions.nearest((e.point / e.range).cast<float>(),
                                                      spacing * spacing);
    if (ray.index < 0) {
      ++check_.unseen;
      return;
    }
    const Eigen::Vector3f& point =
        surface_.elements.points[static_cast<std::size_t>(ray.index)];
    const auto reach = static_cast<float>(kApart * (tolerance_ + element_));
    const bool is_own =
        model_.tree
            .nearest((T_model_scene_ * point.cast<double>()).cast<float>(),
                     reach * reach)
            .index >= 0;
    if (!is_own && point.norm() < e.range - kApart * tolerance_ / e.cosine)
      ++check_.occluded;
  }

  const LocalizationScene& scene_;
  const SceneSurface& surface_;
  const ModelSurface& model_;
  Eigen::Isometry3d T_model_scene_;
  double element_;
  double tolerance_;
  PoseCheck check_;
  double squares_ = 0;
};

/** Counts the supporting elements from where the surface goes on beyond the object. */
void
checkContinuation(const SceneSurface& surface,
                  const PointTree& model_tree,
                  const Eigen::Isometry3d& T_model_scene,
                  double tolerance,
                  PoseCheck& check)
{
  const Surfels& surfels = surface.cloud.surfels();
  for (const auto element : check.support) {
    const double near = tolerance + surface.noise[element];
    const auto beyond = static_cast<float>(4 * near * near);
    const auto goesOn = [&](std::uint32_t next) {
      const Eigen::Vector3d place = T_model_scene * surfels.points[next].cast<double>();
      if (model_tree.nearest(place.cast<float>(), beyond).index >= 0)
        return false;
      const Eigen::Vector3f& normal = surfels.normals[element];
      const float off = normal.dot(surfels.points[next] - surfels.points[element]);
      return surfels.normals[next].dot(normal) > kSmooth &&
             std::abs(off) < static_cast<float>(near);
    };
    if (std::any_of(surfels.links.begin() + surfels.link_begin[element],
                    surfels.links.begin() + surfels.link_begin[element + 1],
                    goesOn))
      ++check.continued;
  }
}
} // namespace

PoseCheck
checkPose(const LocalizationScene& scene,
          const SceneSurface& surface,
          const ModelSurface& model,
          const Eigen::Isometry3d& T_scene_model,
          double tolerance)
{
  RayCheck rays(scene, surface, model, T_scene_model, tolerance);
  for (const FacingElement& e :
       facingElements(model.surface, T_scene_model, model.element))
    rays.add(e);
  PoseCheck check = std::move(rays).result();
  checkContinuation(surface, model.tree, T_scene_model.inverse(), tolerance, check);
  return check;
}

} // namespace pcl6d
