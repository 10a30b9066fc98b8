// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/object_localization/upright_poses.h>
#include <pcl6d/search/point_tree.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
constexpr int kHeadings = 72;            // in a turn
constexpr std::size_t kMostPoints = 150; // that vote; evenly taken
constexpr double kSlack = 3; // cells that points may be outside of the model

/** A heading and a shift of the model's base. */
struct Placing {
  double score;
  int heading;
  Eigen::Vector2d shift; // [m] shift of points in the model's orientation, into its
                         // frame
};

Eigen::Matrix3d
turnBy(double angle)
{
  const SinCos turn = portableSinCos(angle);
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() << turn.cos, -turn.sin, turn.sin, turn.cos;
  return R;
}

/** \return nearness of shifted points to the surface: 1 on the surface, 0 off */
double
nearness(const DistanceField& model,
         const std::vector<Eigen::Vector3d>& points,
         const Eigen::Vector2d& shift)
{
  double sum = 0;
  for (const auto& p : points)
    sum += model.at({p.x() + shift.x(), p.y() + shift.y(), p.z()});
  return 1 - sum / (model.reach() * static_cast<double>(points.size()));
}

/** Scores every shift of points with one heading, in steps of a cell. */
void
addPlacings(const DistanceField& model,
            const Eigen::AlignedBox3d& box,
            const std::vector<Eigen::Vector3d>& points,
            int heading,
            std::vector<Placing>& placings)
{
  Eigen::AlignedBox3d extent;
  for (const auto& p : points)
    extent.extend(p);
  const Eigen::Vector2d slack = Eigen::Vector2d::Constant(kSlack * model.cell());
  const Eigen::Vector2d a = (box.min() - extent.min()).head<2>();
  const Eigen::Vector2d b = (box.max() - extent.max()).head<2>();
  const Eigen::Vector2d low = a.cwiseMin(b) - slack;
  const Eigen::Vector2d high = a.cwiseMax(b) + slack;
  for (double x = low.x(); x <= high.x(); x += model.cell())
    for (double y = low.y(); y <= high.y(); y += model.cell()) {
      const Eigen::Vector2d shift(x, y);
      placings.push_back({nearness(model, points, shift), heading, shift});
    }
}

/** An even subset of the points, in the frame of the base. */
std::vector<Eigen::Vector3d>
onBase(const Points& points, const Eigen::Isometry3d& T_base_scene, double bottom)
{
  const std::size_t stride = (points.size() + kMostPoints - 1) / kMostPoints;
  std::vector<Eigen::Vector3d> some;
  for (std::size_t i = 0; i < points.size(); i += stride)
    some.push_back(T_base_scene * points[i].cast<double>() +
                   Eigen::Vector3d(0, 0, bottom));
  return some;
}

bool
areNear(const Placing& a, const Placing& b, int headings, double cell)
{
  const int turn = std::abs(a.heading - b.heading);
  return std::min(turn, headings - turn) <= 2 &&
         (a.shift - b.shift).squaredNorm() < 9 * cell * cell;
}
} // namespace

DistanceField::DistanceField(const Points& points, double cell, double reach)
: cell_(cell), reach_(reach)
{
  require(!points.empty(), "number of points", points.size(), "> 0");
  require(cell > 0 && std::isfinite(cell), "cell", cell, "> 0");
  require(reach > cell && std::isfinite(reach), "reach", reach, "> cell");
  Eigen::AlignedBox3d box;
  for (const auto& p : points)
    box.extend(p.cast<double>());
  origin_ = box.min() - Eigen::Vector3d::Constant(reach);
  const Eigen::Array3d cells = ((box.sizes().array() + 2 * reach) / cell).ceil();
  constexpr double kMostCells = 1 << 26; // 256 MB of distances
  require(cells.prod() <= kMostCells, "number of cells", cells.prod(), "<= 2^26");
  size_ = cells.cast<int>();
  const PointTree tree(points);
  const auto reach_sq = static_cast<float>(reach * reach);
  for (int z = 0; z < size_.z(); ++z)
    for (int y = 0; y < size_.y(); ++y)
      for (int x = 0; x < size_.x(); ++x) {
        const Eigen::Vector3d middle =
            origin_ + cell * (Eigen::Vector3d(x, y, z).array() + 0.5).matrix();
        const Neighbour near = tree.nearest(middle.cast<float>(), reach_sq);
        distances_.push_back(near.index < 0 ? static_cast<float>(reach)
                                            : std::sqrt(near.distance_sq));
      }
}

double
DistanceField::at(const Eigen::Vector3d& point) const
{
  const Eigen::Vector3d place = (point - origin_) / cell_;
  if (!((place.array() >= 0).all() &&
        (place.array() < size_.cast<double>().array()).all()))
    return reach_;
  const Eigen::Vector3i i = place.cast<int>();
  const auto index =
      (static_cast<std::size_t>(i.z()) * static_cast<std::size_t>(size_.y()) +
       static_cast<std::size_t>(i.y())) *
          static_cast<std::size_t>(size_.x()) +
      static_cast<std::size_t>(i.x());
  return distances_[index];
}

std::vector<VotedPose>
uprightPoses(const DistanceField& model,
             const Eigen::AlignedBox3d& box,
             const ObjectSymmetry& symmetry,
             const Points& points,
             const Eigen::Isometry3d& T_scene_base,
             std::size_t max_poses)
{
  if (points.empty())
    return {};
  const auto some = onBase(points, T_scene_base.inverse(), box.min().z());
  const int headings = symmetry.isRound() ? 1 : std::max(kHeadings / symmetry.turns, 1);
  std::vector<Placing> placings;
  for (int heading = 0; heading < headings; ++heading) {
    const Eigen::Matrix3d R = turnBy(-heading * 2 * M_PI / kHeadings);
    std::vector<Eigen::Vector3d> turned;
    for (const auto& p : some)
      turned.push_back(R * p);
    addPlacings(model, box, turned, heading, placings);
  }
  std::stable_sort(placings.begin(), placings.end(), [](const auto& a, const auto& b) {
    return a.score > b.score;
  });
  std::vector<Placing> best;
  for (const auto& placing : placings) {
    if (best.size() == max_poses)
      break;
    const auto isNear = [&](const auto& b) {
      return areNear(placing, b, headings, model.cell());
    };
    if (std::none_of(best.begin(), best.end(), isNear))
      best.push_back(placing);
  }
  std::vector<VotedPose> poses;
  for (const auto& placing : best) {
    Eigen::Isometry3d T_base_model = Eigen::Isometry3d::Identity();
    T_base_model.linear() = turnBy(placing.heading * 2 * M_PI / kHeadings);
    T_base_model.translation() =
        T_base_model.linear() *
        -Eigen::Vector3d(placing.shift.x(), placing.shift.y(), box.min().z());
    poses.push_back({T_scene_base * T_base_model, placing.score});
  }
  return poses;
}

} // namespace pcl6d
