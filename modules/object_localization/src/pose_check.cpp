// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/object_localization/pose_check.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace pcl6d {

namespace {
/** Steeper, a surface is not seen well enough to speak of it. */
constexpr double kGrazing = 0.17; // cosine of 80 deg

/** A point of the model that faces the scanner. */
struct FacingPoint {
  Eigen::Vector3d place;
  Eigen::Vector3d normal;
  double cosine; // of the angle of sight
  PixelRange seen;
};

std::int64_t
keyOf(const Pixel& pixel)
{
  return (std::int64_t{pixel.row} << 32) + pixel.col;
}

/** The nearest range of the model by pixel, a pixel wider all around, so that its points
 * close gaps. */
class OwnShadow {
public:
  void
  add(const PixelRange& seen)
  {
    for (int row = -1; row <= 1; ++row)
      for (int col = -1; col <= 1; ++col) {
        const Pixel pixel{seen.pixel.row + row, seen.pixel.col + col};
        const auto [place, isNew] = nearest_.try_emplace(keyOf(pixel), seen.range);
        if (!isNew)
          place->second = std::min(place->second, seen.range);
      }
  }

  bool
  hides(const PixelRange& seen, double margin) const
  {
    return seen.range > nearest_.at(keyOf(seen.pixel)) + margin;
  }

private:
  std::unordered_map<std::int64_t, double> nearest_;
};

std::vector<FacingPoint>
facingPoints(const OrientedPoints& model,
             const Eigen::Isometry3d& T_scene_model,
             const RangeProjection& projection,
             double margin)
{
  std::vector<FacingPoint> facing;
  OwnShadow shadow;
  for (std::size_t i = 0; i < model.size(); ++i) {
    const Eigen::Vector3d place = T_scene_model * model.points[i].cast<double>();
    const Eigen::Vector3d normal =
        T_scene_model.linear() * model.normals[i].cast<double>();
    const auto seen = projection.project(place);
    if (!seen)
      continue;
    shadow.add(*seen);
    const double cosine = -normal.dot(place) / seen->range;
    if (cosine > kGrazing)
      facing.push_back({place, normal, cosine, *seen});
  }
  const auto isHidden = [&](const FacingPoint& p) {
    return shadow.hides(p.seen, margin / p.cosine);
  };
  facing.erase(std::remove_if(facing.begin(), facing.end(), isHidden), facing.end());
  return facing;
}

/** \return the scan's surface at a place: its index, or -1 if there is none that fits */
int
surfaceAt(const FacingPoint& p,
          const SceneSurface& surface,
          double tolerance,
          double& distance)
{
  const auto reach = static_cast<float>(3 * tolerance);
  const Neighbour near = surface.tree.nearest(p.place.cast<float>(), reach * reach);
  if (near.index < 0)
    return -1;
  const auto i = static_cast<std::size_t>(near.index);
  const Eigen::Vector3d normal = surface.elements.normals[i].cast<double>();
  distance = normal.dot(p.place - surface.elements.points[i].cast<double>());
  constexpr double kSameSide = 0.5; // cosine of 60 deg
  const bool fits = !surface.large[i] && std::abs(distance) <= tolerance &&
                    normal.dot(p.normal) > kSameSide;
  return fits ? near.index : -1;
}
/** Counts the supporting elements from where the surface goes on beyond the object. */
void
checkContinuation(const SceneSurface& surface,
                  const PointTree& model_tree,
                  const Eigen::Isometry3d& T_model_scene,
                  double tolerance,
                  PoseCheck& check)
{
  constexpr float kSmooth = 0.94F; // cosine of 20 deg
  constexpr double kBeyond = 2;    // times the tolerance
  const Surfels& surfels = surface.cloud.surfels();
  const auto reach = static_cast<float>(kBeyond * kBeyond * tolerance * tolerance);
  for (const auto element : check.support) {
    bool goes_on = false;
    for (auto l = surfels.link_begin[element]; l < surfels.link_begin[element + 1];
         ++l) {
      const std::uint32_t next = surfels.links[l];
      const Eigen::Vector3d place = T_model_scene * surfels.points[next].cast<double>();
      if (model_tree.nearest(place.cast<float>(), reach).index >= 0)
        continue;
      const Eigen::Vector3f& normal = surfels.normals[element];
      const float off = normal.dot(surfels.points[next] - surfels.points[element]);
      goes_on = goes_on || (surfels.normals[next].dot(normal) > kSmooth &&
                            std::abs(off) < static_cast<float>(tolerance));
    }
    check.continued += goes_on ? 1 : 0;
  }
}
} // namespace

PoseCheck
checkPose(const LocalizationScene& scene,
          const SceneSurface& surface,
          const OrientedPoints& model,
          const PointTree& model_tree,
          const Eigen::Isometry3d& T_scene_model,
          double tolerance)
{
  const RangeImage& ranges = scene.ranges();
  PoseCheck check;
  double squares = 0;
  for (const FacingPoint& p :
       facingPoints(model, T_scene_model, ranges.projection(), 2 * tolerance)) {
    double distance = 0;
    const int i = surfaceAt(p, surface, tolerance, distance);
    const double seen = ranges.range(p.seen.pixel);
    const double margin = 2 * tolerance / p.cosine;
    if (i >= 0) {
      ++check.supported;
      squares += distance * distance;
      check.support.push_back(static_cast<std::uint32_t>(i));
    }
    else if (std::isnan(seen))
      ++check.unseen;
    else if (seen > p.seen.range + margin)
      ++check.refuted;
    else if (seen < p.seen.range - margin)
      ++check.occluded;
    else
      ++check.misfit;
  }
  if (check.supported > 0)
    check.rms = std::sqrt(squares / static_cast<double>(check.supported));
  std::sort(check.support.begin(), check.support.end());
  check.support.erase(std::unique(check.support.begin(), check.support.end()),
                      check.support.end());
  checkContinuation(surface, model_tree, T_scene_model.inverse(), tolerance, check);
  return check;
}

} // namespace pcl6d
