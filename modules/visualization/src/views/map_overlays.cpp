// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/colours.h"
#include "drawing/point_spread.h"
#include "drawing/theme.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/require.h>
#include <pcl6d/visualization/map_overlays.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace pcl6d {
using namespace visualization;

namespace {
constexpr Colour kRefused{125, 118, 122};
constexpr Colour kOdometry{80, 150, 255};
constexpr Colour kDoubtful{255, 60, 80};

std::string
inMetres(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.2g m", value);
  return text;
}

/** Range of residuals of the colours. */
struct ResidualRange {
  double low = 0;
  double high = 0;

  explicit ResidualRange(const std::vector<ViewLink>& links)
  {
    std::vector<float> values;
    for (const auto& link : links)
      if (link.state == LinkState::kUsed && std::isfinite(link.rms))
        values.push_back(static_cast<float>(link.rms));
    if (values.empty())
      return;
    low = quantile(values, 0.02);
    high = quantile(std::move(values), 0.98);
  }
  Colour
  colourOf(double rms) const
  {
    constexpr double kSteps = 12; // lines of one colour are drawn in one call
    const double share = (rms - low) / std::max(high - low, 1e-9);
    return warningColour(std::round(kSteps * share) / kSteps);
  }
};

Overlay::Line
lineOf(const ViewLink& link,
       const Trajectory& poses,
       const ResidualRange& range,
       double width)
{
  Overlay::Line line;
  line.points = {poses.poses[link.from].translation(),
                 poses.poses[link.to].translation()};
  line.width = link.state == LinkState::kRefused ? 1.4 : width;
  line.colour = link.state == LinkState::kRefused    ? kRefused
                : link.state == LinkState::kOdometry ? kOdometry
                                                     : range.colourOf(link.rms);
  return line;
}

std::vector<Overlay::Key>
keysOf(const std::vector<ViewLink>& links, const ResidualRange& range)
{
  std::vector<Overlay::Key> keys;
  const auto has = [&](LinkState state) {
    return std::any_of(links.begin(), links.end(), [&](const auto& link) {
      return link.state == state;
    });
  };
  if (has(LinkState::kUsed)) {
    keys.push_back({"used, rms " + inMetres(range.low), range.colourOf(range.low)});
    keys.push_back({inMetres(range.high), range.colourOf(range.high)});
  }
  if (has(LinkState::kOdometry))
    keys.push_back({"odometry", kOdometry});
  if (has(LinkState::kRefused))
    keys.push_back({"refused", kRefused});
  return keys;
}

/** Three circles of an ellipsoid. \param[in] axes half axes in the columns [m] */
void
addEllipsoid(const Eigen::Vector3d& centre,
             const Eigen::Matrix3d& axes,
             const Colour& colour,
             Overlay& overlay)
{
  constexpr int kCorners = 48;
  for (int skipped = 0; skipped < 3; ++skipped) {
    const Eigen::Vector3d a = axes.col((skipped + 1) % 3);
    const Eigen::Vector3d b = axes.col((skipped + 2) % 3);
    Overlay::Line line{{}, colour, 1.5};
    for (int i = 0; i <= kCorners; ++i) {
      const double angle = 2 * M_PI * i / kCorners;
      line.points.push_back(centre + std::cos(angle) * a + std::sin(angle) * b);
    }
    overlay.lines.push_back(line);
  }
}

/** Half axes of three standard deviations. */
Eigen::Matrix3d
axesOf(const Eigen::Matrix3d& covariance)
{
  const auto eigen = symmetricEigen<3>(0.5 * (covariance + covariance.transpose()));
  const Eigen::Vector3d deviations = eigen.values.cwiseMax(0).cwiseSqrt();
  return 3 * eigen.vectors * deviations.asDiagonal();
}

/** A round factor that enlarges the typical ellipsoid to a fortieth of the path's extent. */
double
enlargementFor(const Trajectory& poses, const std::vector<float>& sizes)
{
  Eigen::AlignedBox3d box;
  for (const auto& pose : poses.poses)
    if (pose.translation().allFinite())
      box.extend(Eigen::Vector3d(pose.translation()));
  const double extent = std::max(box.isEmpty() ? 0 : box.diagonal().norm(), 1.0);
  const double usual = quantile(sizes, 0.5);
  const double wanted = extent / 40 / std::max(usual, 1e-9);
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  const double digit = wanted / power;
  return std::max(1.0, power * (digit >= 5 ? 5 : digit >= 2 ? 2 : 1));
}
} // namespace

Overlay
graphOverlay(const Trajectory& poses,
             const std::vector<ViewLink>& links,
             const std::vector<bool>& doubtful,
             Background background)
{
  const std::size_t count = poses.poses.size();
  require(doubtful.empty() || doubtful.size() == count,
          "number of doubtful",
          doubtful.size(),
          "empty or equal to the number of poses");
  for (const auto& link : links)
    require(std::max(link.from, link.to) < count,
            "link to pose",
            std::max(link.from, link.to),
            "one of the trajectory");
  const ResidualRange range(links);
  // Rejected links below, then the used links with the worst on top, then odometry.
  std::vector<ViewLink> ordered = links;
  const auto rank = [](const ViewLink& link) {
    const int state = link.state == LinkState::kRefused ? 0
                      : link.state == LinkState::kUsed  ? 1
                                                        : 2;
    return std::pair(state, std::isfinite(link.rms) ? link.rms : 0.0);
  };
  std::stable_sort(ordered.begin(), ordered.end(), [&](const auto& a, const auto& b) {
    return rank(a) < rank(b);
  });
  const double width = links.size() > 6 * count ? 1.2 : 2; // many hide each other
  Overlay overlay;
  for (const auto& link : ordered)
    overlay.lines.push_back(lineOf(link, poses, range, width));
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_doubtful = !doubtful.empty() && doubtful[i];
    overlay.marks.push_back({poses.poses[i].translation(),
                             is_doubtful ? kDoubtful : themeOf(background).text,
                             is_doubtful ? 11.0 : 7.0});
  }
  overlay.keys = keysOf(links, range);
  if (std::find(doubtful.begin(), doubtful.end(), true) != doubtful.end())
    overlay.keys.push_back({"doubtful scan", kDoubtful});
  return overlay;
}

Overlay
covarianceOverlay(const Trajectory& poses,
                  const std::vector<std::optional<Eigen::Matrix3d>>& covariances,
                  Background background)
{
  require(covariances.size() == poses.poses.size(),
          "number of covariances",
          covariances.size(),
          "one per pose");
  std::vector<float> sizes;
  for (const auto& covariance : covariances)
    if (covariance && covariance->allFinite() && !covariance->isZero())
      sizes.push_back(
          static_cast<float>(axesOf(*covariance).colwise().norm().maxCoeff()));
  Overlay overlay;
  const double factor = sizes.empty() ? 1 : enlargementFor(poses, sizes);
  const Colour colour{255, 190, 60};
  for (std::size_t i = 0; i < poses.poses.size(); ++i) {
    const Eigen::Vector3d place = poses.poses[i].translation();
    const auto& covariance = covariances[i];
    const bool known = covariance && covariance->allFinite();
    if (known)
      addEllipsoid(place, factor * axesOf(*covariance), colour, overlay);
    overlay.marks.push_back({place, known ? themeOf(background).text : kDoubtful, 6});
  }
  std::ostringstream text;
  text << "3 sigma of the positions, " << factor << " times as large";
  overlay.keys.push_back({text.str(), colour});
  if (sizes.size() + 1 < covariances.size()) // the first scan has no covariance
    overlay.keys.push_back({"not known", kDoubtful});
  return overlay;
}

Overlay
objectOverlay(const std::vector<ObjectPose>& objects, Background background)
{
  Overlay overlay;
  std::vector<std::string> classes;
  for (const auto& object : objects) {
    const auto known = std::find(classes.begin(), classes.end(), object.object_class);
    const auto number = static_cast<std::size_t>(known - classes.begin());
    if (known == classes.end()) {
      classes.push_back(object.object_class);
      overlay.keys.push_back({object.object_class, distinctColour(number)});
    }
    const Colour colour = distinctColour(number);
    const auto corner = [&](int i) -> Eigen::Vector3d {
      return object.T_world_object *
             object.box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
    };
    for (int i = 0; i < 8; ++i) // bits of the corner: x, y, z
      for (const int axis : {1, 2, 4})
        if ((i & axis) == 0)
          overlay.lines.push_back({{corner(i), corner(i | axis)}, colour, 2});
    const Eigen::Vector3d top = 0.5 * (corner(4) + corner(7));
    overlay.texts.push_back({top, object.object_class, themeOf(background).text});
  }
  return overlay;
}

} // namespace pcl6d
