// SPDX-License-Identifier: BSD-3-Clause
#include "ring_graph.h"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

using namespace pcl6d;
using namespace pcl6d::test;

namespace {
/** The two dense systems of 5.3.3, summed pair by pair, with poses [R t] T in the world. */
struct DenseSystems {
  explicit DenseSystems(Eigen::Index scans)
  : G(Eigen::MatrixXd::Zero(3 * scans, 3 * scans))
  , L(Eigen::MatrixXd::Zero(scans, scans))
  , turns(Eigen::VectorXd::Zero(3 * scans))
  {}

  Eigen::MatrixXd G, L;
  Eigen::VectorXd turns;
};

struct CentredLink {
  std::vector<Eigen::Vector3d> a, b;
  Eigen::Vector3d ca, cb;
};

CentredLink
centred(const Poses& poses, const LinkPairs& link)
{
  CentredLink points{{}, {}, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  const auto size = static_cast<double>(link.points_from.size());
  for (std::size_t k = 0; k < link.points_from.size(); ++k) {
    points.a.push_back(poses[link.from] * link.points_from[k].cast<double>());
    points.b.push_back(poses[link.to] * link.points_to[k].cast<double>());
    points.ca += points.a.back() / size;
    points.cb += points.b.back() / size;
  }
  for (std::size_t k = 0; k < points.a.size(); ++k) {
    points.a[k] -= points.ca;
    points.b[k] -= points.cb;
  }
  return points;
}

void
addLink(const CentredLink& points,
        Eigen::Index i,
        Eigen::Index j,
        DenseSystems& systems)
{
  for (std::size_t k = 0; k < points.a.size(); ++k) {
    const Eigen::Vector3d &a = points.a[k], &b = points.b[k];
    // (a.b) I - b a^T = [a]x^T [b]x
    systems.G.block<3, 3>(3 * i, 3 * i) += skew(a).transpose() * skew(a);
    systems.G.block<3, 3>(3 * j, 3 * j) += skew(b).transpose() * skew(b);
    systems.G.block<3, 3>(3 * i, 3 * j) -= skew(a).transpose() * skew(b);
    systems.G.block<3, 3>(3 * j, 3 * i) -= skew(b).transpose() * skew(a);
    systems.turns.segment<3>(3 * i) += a.cross(b);
    systems.turns.segment<3>(3 * j) -= a.cross(b);
  }
  const auto size = static_cast<double>(points.a.size());
  systems.L(i, i) += size;
  systems.L(j, j) += size;
  systems.L(i, j) -= size;
  systems.L(j, i) -= size;
}
} // namespace

TEST(SmallAngleStep, SolvesTheTwoSystemsOfTheBook)
{
  GraphRecipe recipe;
  recipe.start_turn = 0.03;
  const GraphCase graph = makeGraph(recipe);
  const auto scans = static_cast<Eigen::Index>(graph.start.size());
  DenseSystems systems(scans);
  std::vector<CentredLink> links;
  for (const LinkPairs& link : graph.links) {
    links.push_back(centred(graph.start, link));
    addLink(links.back(), link.from, link.to, systems);
  }
  // The first pose is fixed.
  const Eigen::Index free = scans - 1;
  const Eigen::VectorXd theta = systems.G.bottomRightCorner(3 * free, 3 * free)
                                    .ldlt()
                                    .solve(systems.turns.tail(3 * free));
  std::vector<Eigen::Matrix3d> R{Eigen::Matrix3d::Identity()};
  for (Eigen::Index j = 0; j < free; ++j)
    R.push_back(rotationFromVector(theta.segment<3>(3 * j)));
  Eigen::MatrixXd f = Eigen::MatrixXd::Zero(scans, 3);
  for (std::size_t l = 0; l < links.size(); ++l) {
    const std::size_t a = graph.links[l].from, b = graph.links[l].to;
    const Eigen::RowVector3d r = 60 * (R[b] * links[l].cb - R[a] * links[l].ca);
    f.row(a) += r;
    f.row(b) -= r;
  }
  const Eigen::MatrixXd t =
      systems.L.bottomRightCorner(free, free).ldlt().solve(f.bottomRows(free));

  GraphSlamOptions options = exactOptions(Relaxation::kSmallAngle);
  options.max_iterations = 1;
  const auto result = GraphSlam(options).relax(graph.start, graph.links);
  for (Eigen::Index j = 1; j < scans; ++j) {
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    motion.linear() = R[j];
    motion.translation() = t.row(j - 1);
    const Eigen::Isometry3d expected = motion * graph.start[j];
    EXPECT_LT((result.poses[j].matrix() - expected.matrix()).norm(), 1e-10);
  }
}
