// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>
#include <pcl6d/common/number_range.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/localisation/monte_carlo_localisation.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl6d {
namespace {
constexpr std::size_t kBlock = 64; // particles

/** Turns and shifts a point from the levelled frame of a scan into the plan. */
class PlanTransform {
public:
  explicit PlanTransform(const Eigen::Vector3d& pose)
  : turn_(portableSinCos(pose.z())), shift_(pose.head<2>())
  {}

  Eigen::Vector2d
  operator*(const Eigen::Vector2d& p) const
  {
    return {shift_.x() + turn_.cos * p.x() - turn_.sin * p.y(),
            shift_.y() + turn_.sin * p.x() + turn_.cos * p.y()};
  }

private:
  SinCos turn_;
  Eigen::Vector2d shift_;
};

/** A motion as two turns and a way between them, which may go backwards. */
struct TurnWayTurn {
  double first = 0, way = 0, second = 0;
};

TurnWayTurn
split(const Eigen::Vector3d& motion)
{
  constexpr double kStanding = 1e-3; // [m] below, the way has no direction
  TurnWayTurn parts;
  parts.way = motion.head<2>().norm();
  if (parts.way > kStanding)
    parts.first = portableAtan2(motion.y(), motion.x());
  if (std::abs(parts.first) > M_PI_2) {
    parts.way = -parts.way;
    parts.first = wrapAngle(parts.first + M_PI);
  }
  parts.second = wrapAngle(motion.z() - parts.first);
  return parts;
}
} // namespace

MonteCarloLocalisation::MonteCarloLocalisation(
    const SegmentMap& map,
    const std::optional<Eigen::Vector3d>& start,
    const MclOptions& options)
: map_(map), options_(options), random_(options.seed)
{
  options_.validate();
  if (start && !start->allFinite())
    throw BadArgument("the start pose is not finite");
  particles_.resize(start ? options_.num_particles : options_.max_particles);
  for (auto& particle : particles_) {
    if (start) {
      const double x = random_.normal(), y = random_.normal(), yaw = random_.normal();
      particle.pose = *start + Eigen::Vector3d(options_.start_position * x,
                                               options_.start_position * y,
                                               options_.start_yaw * yaw);
    }
    else {
      const double x = random_.uniform(map.low().x(), map.high().x());
      const double y = random_.uniform(map.low().y(), map.high().y());
      particle.pose = {x, y, random_.uniform(-M_PI, M_PI)};
    }
  }
}

void
MonteCarloLocalisation::move(const Eigen::Vector3d& motion)
{
  constexpr double kLeastTurn = 0.002; // [rad]
  constexpr double kLeastWay = 0.01;   // [m]
  const TurnWayTurn parts = split(motion);
  const double turns = std::abs(parts.first) + std::abs(parts.second);
  const auto turnSigma = [&](double turn) {
    return kLeastTurn + options_.rotation_per_rotation * std::abs(turn) +
           options_.rotation_per_metre * std::abs(parts.way);
  };
  const double first_sigma = turnSigma(parts.first);
  const double second_sigma = turnSigma(parts.second);
  const double way_sigma = kLeastWay +
                           options_.translation_per_metre * std::abs(parts.way) +
                           options_.translation_per_rotation * turns;
  for (auto& particle : particles_) {
    const double first = parts.first + first_sigma * random_.normal();
    const double way = parts.way + way_sigma * random_.normal();
    const double second = parts.second + second_sigma * random_.normal();
    const PlanTransform there(
        {particle.pose.x(), particle.pose.y(), wrapAngle(particle.pose.z() + first)});
    particle.pose.head<2>() = there * Eigen::Vector2d(way, 0);
    particle.pose.z() = wrapAngle(particle.pose.z() + first + second);
  }
}

void
MonteCarloLocalisation::weigh(const VirtualScan& scan)
{
  const double scale = -1 / (2 * options_.hit_sigma * options_.hit_sigma);
  std::vector<double> news(particles_.size());
  parallelBlocks(
      particles_.size(), kBlock, options_.num_threads, [&](const Block& block) {
        for (std::size_t i = block.begin; i < block.end; ++i) {
          const PlanTransform T_map_scan(particles_[i].pose);
          particles_[i].agreeing = 0;
          for (const auto& point : scan.points) {
            const double d = map_.distance(T_map_scan * point);
            particles_[i].agreeing += d <= options_.agreement_distance ? 1 : 0;
            news[i] += portableLog(options_.hit_share * portableExp(scale * d * d) +
                                   (1 - options_.hit_share));
          }
        }
      });
  const auto best = std::max_element(
      particles_.begin(), particles_.end(), [](const auto& a, const auto& b) {
        return a.agreeing < b.agreeing;
      });
  if (static_cast<double>(best->agreeing) <
      options_.min_agreement * static_cast<double>(scan.points.size()))
    return; // nowhere on the map
  for (std::size_t i = 0; i < particles_.size(); ++i)
    particles_[i].log_weight += options_.beam_independence * news[i];
}

std::vector<double>
MonteCarloLocalisation::weights() const
{
  double largest = particles_.front().log_weight;
  for (const auto& particle : particles_)
    largest = std::max(largest, particle.log_weight);
  std::vector<double> weights;
  weights.reserve(particles_.size());
  double sum = 0;
  for (const auto& particle : particles_) {
    weights.push_back(portableExp(particle.log_weight - largest));
    sum += weights.back();
  }
  for (double& weight : weights)
    weight /= sum;
  return weights;
}

/** The number of particles that keeps the error of the distribution over k bins below epsilon, with
 * a probability of 99 % (Fox 2003, eq. 7). */
std::size_t
MonteCarloLocalisation::wantedParticles() const
{
  constexpr double kBinSize = 0.5, kBinYaw = M_PI / 18; // [m], [rad]
  constexpr double kEpsilon = 0.05, kQuantile = 2.326;
  std::vector<std::array<int, 3>> bins;
  for (const auto& particle : particles_)
    bins.push_back({clampedTo<int>(std::floor(particle.pose.x() / kBinSize)),
                    clampedTo<int>(std::floor(particle.pose.y() / kBinSize)),
                    clampedTo<int>(std::floor(particle.pose.z() / kBinYaw))});
  std::sort(bins.begin(), bins.end());
  const auto k =
      static_cast<double>(std::unique(bins.begin(), bins.end()) - bins.begin());
  if (k < 2)
    return options_.num_particles;
  const double a = 2 / (9 * (k - 1));
  const double root = 1 - a + std::sqrt(a) * kQuantile;
  const double count = (k - 1) / (2 * kEpsilon) * root * root * root;
  return static_cast<std::size_t>(
      std::clamp(count,
                 static_cast<double>(options_.num_particles),
                 static_cast<double>(options_.max_particles)));
}

/** Low variance resampling, when the weights are unequal or the number is far from
 * wantedParticles(). */
void
MonteCarloLocalisation::resample()
{
  const std::vector<double> w = weights();
  double sum_sq = 0;
  for (const double weight : w)
    sum_sq += weight * weight;
  const auto count = static_cast<double>(w.size());
  const std::size_t wanted = wantedParticles();
  const bool are_unequal = 1 / sum_sq < count / 2;
  const double ratio = static_cast<double>(wanted) / count;
  if (!are_unequal && ratio > 0.5 && ratio < 1.5)
    return;
  std::vector<Particle> drawn;
  drawn.reserve(wanted);
  const double step = 1 / static_cast<double>(wanted);
  double mark = random_.uniform() * step, sum = w.front();
  for (std::size_t i = 0; drawn.size() < wanted; mark += step) {
    while (mark > sum && i + 1 < w.size())
      sum += w[++i];
    drawn.push_back({particles_[i].pose, 0, 0});
  }
  particles_ = std::move(drawn);
}

void
MonteCarloLocalisation::estimate(MclEstimate& result) const
{
  const std::vector<double> w = weights();
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double sine = 0, cosine = 0;
  for (std::size_t i = 0; i < w.size(); ++i) {
    position += w[i] * particles_[i].pose.head<2>();
    const SinCos yaw = portableSinCos(particles_[i].pose.z());
    sine += w[i] * yaw.sin;
    cosine += w[i] * yaw.cos;
  }
  result.pose << position, portableAtan2(sine, cosine);
  result.covariance.setZero();
  for (std::size_t i = 0; i < w.size(); ++i) {
    Eigen::Vector3d d = particles_[i].pose - result.pose;
    d.z() = wrapAngle(d.z());
    result.covariance += w[i] * d * d.transpose();
  }
}

std::size_t
MonteCarloLocalisation::agreeing(const Eigen::Vector3d& pose,
                                 const VirtualScan& scan) const
{
  const PlanTransform T_map_scan(pose);
  return static_cast<std::size_t>(
      std::count_if(scan.points.begin(), scan.points.end(), [&](const auto& point) {
        return map_.distance(T_map_scan * point) <= options_.agreement_distance;
      }));
}

MclDoubt
MonteCarloLocalisation::doubtOf(const MclEstimate& result) const
{
  const Eigen::Matrix2d P = result.covariance.topLeftCorner<2, 2>();
  const double half_difference = (P(0, 0) - P(1, 1)) / 2;
  const double largest =
      P.trace() / 2 + std::sqrt(half_difference * half_difference + P(0, 1) * P(0, 1));
  if (result.walls < options_.min_walls)
    return MclDoubt::kFewWalls;
  if (result.agreement < options_.min_agreement)
    return MclDoubt::kDisagreement;
  if (std::sqrt(largest) > options_.max_spread ||
      std::sqrt(result.covariance(2, 2)) > options_.max_yaw_spread)
    return MclDoubt::kSpread;
  return MclDoubt::kNone;
}

MclEstimate
MonteCarloLocalisation::addScan(const Eigen::Vector3d& motion, const VirtualScan& scan)
{
  if (!motion.allFinite())
    throw BadArgument("the motion to the scan is not finite");
  if (has_moved_)
    move(motion);
  has_moved_ = true;
  MclEstimate result;
  result.particles = particles_.size();
  result.walls = scan.walls;
  if (scan.walls >= options_.min_walls)
    weigh(scan);
  estimate(result);
  if (!scan.points.empty())
    result.agreement = static_cast<double>(agreeing(result.pose, scan)) /
                       static_cast<double>(scan.points.size());
  result.doubt = doubtOf(result);
  resample();
  return result;
}

void
MclOptions::validate() const
{
  require(num_particles > 0, "num_particles", num_particles, "> 0");
  require(max_particles >= num_particles,
          "max_particles",
          max_particles,
          ">= num_particles, " + std::to_string(num_particles));
  const auto requireSigma = [](const char* name, double value) {
    require(std::isfinite(value) && value >= 0, name, value, "finite and >= 0");
  };
  requireSigma("rotation_per_rotation", rotation_per_rotation);
  requireSigma("rotation_per_metre", rotation_per_metre);
  requireSigma("translation_per_metre", translation_per_metre);
  requireSigma("translation_per_rotation", translation_per_rotation);
  requireSigma("start_position", start_position);
  requireSigma("start_yaw", start_yaw);
  const auto requirePositive = [](const char* name, double value) {
    require(std::isfinite(value) && value > 0, name, value, "finite and > 0");
  };
  requirePositive("hit_sigma", hit_sigma);
  require(hit_share > 0 && hit_share < 1, "hit_share", hit_share, "in (0, 1)");
  require(beam_independence > 0 && beam_independence <= 1,
          "beam_independence",
          beam_independence,
          "in (0, 1]");
  requirePositive("agreement_distance", agreement_distance);
  require(min_agreement >= 0 && min_agreement <= 1,
          "min_agreement",
          min_agreement,
          "in [0, 1]");
  requirePositive("max_spread", max_spread);
  requirePositive("max_yaw_spread", max_yaw_spread);
}

const char*
toString(MclDoubt doubt)
{
  constexpr Named<MclDoubt> kDoubts[] = {{MclDoubt::kFewWalls, "few walls"},
                                         {MclDoubt::kDisagreement, "off the map"},
                                         {MclDoubt::kSpread, "spread"},
                                         {MclDoubt::kShortStretch, "short stretch"}};
  return nameOf(kDoubts, doubt, "");
}

Eigen::Vector3d
planarMotion(const Eigen::Isometry3d& T_a_b,
             const Eigen::Matrix3d& R_level_a,
             const Eigen::Matrix3d& R_level_b)
{
  const Eigen::Vector3d way = R_level_a * T_a_b.translation();
  const Eigen::Matrix3d turn = R_level_a * T_a_b.linear() * R_level_b.transpose();
  return {way.x(), way.y(), eulerFromRotation(turn).yaw};
}

void
distrustShortStretches(std::vector<MclEstimate>& estimates, std::size_t min_stretch)
{
  for (std::size_t begin = 0; begin < estimates.size();) {
    std::size_t end = begin;
    while (end < estimates.size() && estimates[end].trusted())
      ++end;
    const bool is_whole = begin == 0 && end == estimates.size();
    if (end - begin < min_stretch && !is_whole)
      for (std::size_t i = begin; i < end; ++i)
        estimates[i].doubt = MclDoubt::kShortStretch;
    begin = end + 1;
  }
}

} // namespace pcl6d
