// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/object_localization/oriented_points.h>
#include <pcl6d/object_localization/pose_check.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace pcl6d {

namespace {
/** \brief A piece of the surface of an object that faces the scanner. */
struct FacingElement {
  std::uint32_t place;    ///< in the model
  Eigen::Vector3d point;  ///< [m] in the scan's frame, with the scanner at the origin
  Eigen::Vector3d normal; ///< unit, in the scan's frame
  double range;           ///< [m] > 0
  double cosine;          ///< of the angle between normal and sight, > 0
};

/** Surfaces at a more grazing angle are not tested. */
constexpr double kGrazing = 0.17; // cosine of 80 deg

/** Largest difference in range of adjacent elements on one surface, in element sizes
 * over the cosine. */
constexpr double kDepth = 2;

/** Depth image of an object from the scanner: on a plane across the line of sight to
 * its middle, with pixels of one element. */
class Picture {
public:
  Picture(const std::vector<FacingElement>& elements,
          const Eigen::Vector3d& middle,
          double element)
  : pixel_(element / std::max(middle.norm(), element))
  {
    axes_.row(2) = middle.normalized();
    axes_.row(0) = axes_.row(2).transpose().unitOrthogonal();
    axes_.row(1) = axes_.row(2).transpose().cross(axes_.row(0).transpose());
    for (const auto& e : elements)
      box_.extend(place(e));
    constexpr int kRim = 1;
    cols_ = box_.isEmpty() ? 0 : box_.sizes().x() + 1 + 2 * kRim;
    const int rows = box_.isEmpty() ? 0 : box_.sizes().y() + 1 + 2 * kRim;
    nearest_.assign(static_cast<std::size_t>(cols_) * static_cast<std::size_t>(rows),
                    std::numeric_limits<double>::infinity());
    for (const auto& e : elements)
      draw(e);
  }

  bool
  hides(const FacingElement& e, double margin) const
  {
    return e.range > nearest_[index(place(e))] + margin / e.cosine;
  }

private:
  Eigen::Vector2i
  place(const FacingElement& e) const
  {
    constexpr double kWidest =
        1000; // pixels off the middle, for elements beside the scanner
    const Eigen::Vector3d p = axes_ * e.point;
    const double depth = std::max(p.z(), 1e-3 * e.range) * pixel_;
    return (p.head<2>() / depth)
        .cwiseMin(kWidest)
        .cwiseMax(-kWidest)
        .array()
        .floor()
        .matrix()
        .cast<int>();
  }

  std::size_t
  index(const Eigen::Vector2i& place) const
  {
    const Eigen::Vector2i p = place - box_.min() + Eigen::Vector2i::Ones();
    return static_cast<std::size_t>(p.y()) * static_cast<std::size_t>(cols_) +
           static_cast<std::size_t>(p.x());
  }

  /** Drawn one pixel wider all around, to close gaps between elements. */
  void
  draw(const FacingElement& e)
  {
    const Eigen::Vector2i middle = place(e);
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        double& nearest = nearest_[index(middle + Eigen::Vector2i(x, y))];
        nearest = std::min(nearest, e.range);
      }
  }

  double pixel_;
  Eigen::Matrix3d axes_;
  Eigen::AlignedBox2i box_;
  int cols_ = 0;
  std::vector<double> nearest_; // range by pixel
};

/** \brief The elements of a model that face the scanner and are not hidden by another
 * element.
 * \param[in] element [m] size of the elements */
std::vector<FacingElement>
facingElements(const OrientedPoints& model,
               const Eigen::Isometry3d& T_scene_model,
               double element)
{
  std::vector<FacingElement> facing;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < model.size(); ++i) {
    const Eigen::Vector3d point = T_scene_model * model.points[i].cast<double>();
    const Eigen::Vector3d normal =
        T_scene_model.linear() * model.normals[i].cast<double>();
    const double range = point.norm();
    const double cosine = -normal.dot(point) / range;
    if (!(cosine > 0)) // the element is turned away, or at the scanner
      continue;
    facing.push_back({static_cast<std::uint32_t>(i), point, normal, range, cosine});
    middle += point;
  }
  if (facing.empty())
    return facing;
  const Picture picture(facing, middle / static_cast<double>(facing.size()), element);
  const auto isUnseen = [&](const FacingElement& e) {
    return e.cosine < kGrazing || picture.hides(e, kDepth * element);
  };
  facing.erase(std::remove_if(facing.begin(), facing.end(), isUnseen), facing.end());
  return facing;
}

constexpr double kSameSide = 0.5; // cosine of 60 deg
constexpr float kSmooth = 0.94F;  // cosine of 20 deg
/** A ray may meet an element within kRayWidth element sizes, and certainly does within
 * kRayCore. */
constexpr double kRayWidth = 0.75;
constexpr double kRayCore = 0.4;
/** In a coarse scan the next ray stands for an element within this number of ray
 * spacings. */
constexpr double kRaySpacing = 0.6;
/** Largest width of an occluding element, in sizes of the hidden element. */
constexpr double kNextElement = 4;
/** Largest distance to the next ray, in ray spacings. */
constexpr double kNextRay = 2;
/** Smallest difference in range between two surfaces, in tolerances. */
constexpr double kApart = 2;
/** Standard deviation as a share of a margin, as RayImage allows three. */
constexpr double kSigma = 1.0 / 3;

/** Classifies the elements of an object by the scan's rays through them. */
class RayCheck {
public:
  RayCheck(const LocalizationScene& scene,
           const SceneSurface& surface,
           double element,
           double tolerance)
  : scene_(scene), surface_(surface), element_(element), tolerance_(tolerance)
  {}

  void
  add(const FacingElement& e)
  {
    ++check_.elements;
    const double width =
        std::max(kRayWidth * element_ / e.range, kRaySpacing * scene_.angularSpacing());
    const auto rays =
        surface_.directions.withinRadius((e.point / e.range).cast<float>(),
                                         static_cast<float>(width * width),
                                         kMostRays);
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

  /** For an element with rays that met another surface. */
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

  /** For an element without a ray: occluded by a piece of surface in front (wider in
   * angle, being nearer), unseen without rays around it, or refuted if every ray around
   * passed behind it. Otherwise the element is not classified. */
  void
  addUnmet(const FacingElement& e)
  {
    const Eigen::Vector3f direction = (e.point / e.range).cast<float>();
    const auto around = static_cast<float>(kNextRay * scene_.angularSpacing());
    const auto wide = static_cast<float>(kNextElement * element_ / e.range);
    const Neighbour ray =
        surface_.directions.nearest(direction, std::max(around * around, wide * wide));
    if (ray.index < 0) {
      ++check_.unseen;
      return;
    }
    const double range = surface_.elements.points[static_cast<std::size_t>(ray.index)]
                             .cast<double>()
                             .norm();
    const double cover = kRayWidth * element_ / range;
    if (ray.distance_sq < cover * cover &&
        range < e.range - kApart * tolerance_ / e.cosine)
      ++check_.occluded;
    else if (ray.distance_sq >= around * around)
      ++check_.unseen;
    else if (isFree(e))
      ++check_.refuted;
  }

  /** Whether every ray around an element passed behind it. */
  bool
  isFree(const FacingElement& e) const
  {
    const double sigma = kSigma * kApart * tolerance_ / e.cosine;
    return scene_.rays().look(e.point.cast<float>(), static_cast<float>(sigma)).sight ==
           Sight::kFree;
  }

  const LocalizationScene& scene_;
  const SceneSurface& surface_;
  double element_;
  double tolerance_;
  PoseCheck check_;
  double squares_ = 0;
};

/** Whether two adjacent elements belong to one surface. With normals: they agree, and
 * each element is on the other's plane. Without: no step in range divides them. */
bool
areJoined(const Surfels& surfels, std::uint32_t a, std::uint32_t b, double tolerance)
{
  const Eigen::Vector3f way = surfels.points[b] - surfels.points[a];
  if (surfels.smooth[a] && surfels.smooth[b])
    return surfels.normals[b].dot(surfels.normals[a]) > kSmooth &&
           std::abs(surfels.normals[a].dot(way)) < static_cast<float>(tolerance);
  constexpr float kSlope = 1.5F; // of a surface at a moderate angle of incidence
  const float depth = std::abs(surfels.points[a].normalized().dot(way));
  const float aside = std::sqrt(std::max(way.squaredNorm() - depth * depth, 0.0F));
  return depth < kSlope * aside;
}

/** Counts the supporting elements whose surface continues beyond the object. */
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
      return !surface.large[next] &&
             !model_tree.hasNeighbour(place.cast<float>(), beyond) &&
             areJoined(surfels, element, next, near);
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
  RayCheck rays(scene, surface, model.element, tolerance);
  for (const FacingElement& e :
       facingElements(model.surface, T_scene_model, model.element))
    rays.add(e);
  PoseCheck check = std::move(rays).result();
  checkContinuation(surface, model.tree, T_scene_model.inverse(), tolerance, check);
  return check;
}

} // namespace pcl6d
