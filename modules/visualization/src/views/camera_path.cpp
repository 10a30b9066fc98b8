// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/visualization/camera_path.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
constexpr double kShortest = 1e-3; // [m] of a path
constexpr double kClosest = 0.05;  // [m] least distance of a viewed position
constexpr int kAverage = 21;       // samples of the path per smoothed position

/** A polyline, parametrised by its length. */
class Way {
public:
  explicit Way(const std::vector<Eigen::Isometry3d>& poses)
  {
    for (const auto& pose : poses)
      if (pose.matrix().allFinite())
        add(pose.translation());
  }

  double
  length() const
  {
    return reached_.empty() ? 0 : reached_.back();
  }

  /** \return the position at a length; extrapolated straight before the start and
   * behind the end */
  Eigen::Vector3d
  at(double s) const
  {
    const auto next = std::upper_bound(reached_.begin(), reached_.end(), s);
    const std::size_t last = places_.size() - 1;
    const auto i = static_cast<std::size_t>(next - reached_.begin());
    const std::size_t b = std::clamp<std::size_t>(i, 1, last), a = b - 1;
    const double share = (s - reached_[a]) / (reached_[b] - reached_[a]);
    return places_[a] + share * (places_[b] - places_[a]);
  }

  /** \return the mean of the positions around a length */
  Eigen::Vector3d
  smoothAt(double s, double width) const
  {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int i = 0; i < kAverage; ++i)
      sum += at(s + width * (static_cast<double>(i) / (kAverage - 1) - 0.5));
    return sum / kAverage;
  }

private:
  void
  add(const Eigen::Vector3d& place)
  {
    const double step = places_.empty() ? 1 : (place - places_.back()).norm();
    if (step < kShortest)
      return;
    reached_.push_back(places_.empty() ? 0 : reached_.back() + step);
    places_.push_back(place);
  }

  std::vector<Eigen::Vector3d> places_;
  std::vector<double> reached_; ///< [m] path length to each position
};

/** \return axes right, down, forward of an upright camera */
Eigen::Matrix3d
uprightAxes(Eigen::Vector3d forward)
{
  if (forward.norm() < kShortest)
    forward = Eigen::Vector3d::UnitX();
  forward.normalize();
  Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ());
  if (right.norm() < 1e-6) // straight up or down
    right = Eigen::Vector3d::UnitX();
  right.normalize();
  Eigen::Matrix3d axes;
  axes << right, forward.cross(right), forward;
  return axes;
}
} // namespace

void
FlyThroughOptions::validate() const
{
  require(count > 1, "count", count, "> 1");
  require(std::isfinite(above), "above", above, "finite");
  require(behind >= 0, "behind", behind, ">= 0");
  require(ahead > 0, "ahead", ahead, "> 0");
  require(smoothing >= 0, "smoothing", smoothing, ">= 0");
  require(field_of_view > 0 && field_of_view < M_PI,
          "field_of_view",
          field_of_view,
          "above 0 and below pi");
}

std::vector<Camera>
turntable(const Camera& first, const Eigen::Vector3d& middle, std::size_t count)
{
  require(count > 0, "count", count, "> 0");
  std::vector<Camera> cameras;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * M_PI * static_cast<double>(i) / static_cast<double>(count);
    const Eigen::Isometry3d turn =
        Eigen::Translation3d(middle) *
        Eigen::Isometry3d(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ())) *
        Eigen::Translation3d(-middle);
    cameras.push_back(first);
    cameras.back().T_world_camera = turn * first.T_world_camera;
  }
  return cameras;
}

std::vector<Camera>
flyThrough(const Trajectory& trajectory,
           const PictureBox& box,
           const FlyThroughOptions& options)
{
  options.validate();
  const Way way(trajectory.poses);
  require(way.length() > 0, "length of the path", way.length(), "at least 1 mm");
  Camera camera;
  camera.scale = 0.5 * (box.right - box.left) / std::tan(0.5 * options.field_of_view);
  camera.centre = {0.5 * (box.left + box.right), 0.5 * (box.top + box.bottom)};
  const double width = std::min(options.smoothing, way.length());
  Eigen::Vector3d forward = way.at(way.length()) - way.at(0);
  std::vector<Camera> cameras;
  for (std::size_t i = 0; i < options.count; ++i) {
    const double s =
        way.length() * static_cast<double>(i) / static_cast<double>(options.count - 1);
    const Eigen::Vector3d here = way.smoothAt(s - options.behind, width) +
                                 options.above * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d there = way.smoothAt(s + options.ahead, width);
    // else the path turns back: keep the direction
    if ((there - here).norm() > kClosest)
      forward = there - here;
    camera.T_world_camera.linear() = uprightAxes(forward);
    camera.T_world_camera.translation() = here;
    cameras.push_back(camera);
  }
  return cameras;
}

} // namespace pcl6d
