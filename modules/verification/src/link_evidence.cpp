// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"

#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/io/text.h>
#include <pcl6d/registration/twist.h>
#include <pcl6d/verification/link_evidence.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace pcl6d {
using namespace verification;

namespace {
/** A part of the points, evenly. */
Points
sampleOf(const Points& points)
{
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kLookedAt);
  Points sample;
  for (std::size_t i = 0; i < points.size(); i += stride)
    sample.push_back(points[i]);
  return sample;
}

/** Surfaces are as far apart where they fit best as noise alone does not show: ranges that
 * are off alike for all points of a wall. */
SightEvidence
lookFrom(const VerifiedScan& from,
         const VerifiedScan& at,
         const Eigen::Isometry3d& T_from_at,
         double voxel,
         const SurfaceFit& fit,
         std::vector<Contradiction>* contradictions)
{
  PlaceUncertainty uncertainty;
  const double misfit = std::min(fit.residual, kMostMisfit * voxel);
  uncertainty.noise = std::sqrt(at.noise() * at.noise() + misfit * misfit);
  return sightEvidence(from.rays(),
                       sampleOf(at.surfaces().points()),
                       T_from_at,
                       uncertainty,
                       std::max(kPatchVoxels * voxel, kPatchSpread * fit.spread),
                       contradictions);
}

/** Where the surfaces would move a link to, in a few steps, and how well they say it. */
SurfaceFit
settled(const VerifiedScan& first,
        const VerifiedScan& second,
        const Eigen::Isometry3d& T_first_second,
        double voxel)
{
  constexpr int kSteps = 4;
  constexpr double kPairVoxels = 1.7; // as matching by planes pairs them
  SurfaceFitOptions options;
  options.max_distance = kPairVoxels * voxel;
  Eigen::Isometry3d T = T_first_second;
  options.covariance = false;
  SurfaceFit fit = fitSurfaces(first, second, T, options);
  Twist moved = fit.step;
  for (int k = 1; k < kSteps && fit.spread > 0; ++k) {
    options.covariance = k + 1 == kSteps;
    Eigen::Isometry3d motion = motionFromTwist(fit.step);
    motion = Eigen::Translation3d(fit.centroid) * motion *
             Eigen::Translation3d(-fit.centroid);
    const SurfaceFit next = fitSurfaces(first, second, motion * T, options);
    if (next.spread == 0) { // it lost its pairs
      options.covariance = true;
      fit = fitSurfaces(first, second, T, options);
      break;
    }
    T = motion * T;
    moved += next.step;
    fit = next;
  }
  fit.step = moved;
  return fit;
}

/** Stirling's series, for x > 0 within 1e-10; from + - * / alone, for the same bits. */
double
logGamma(double x)
{
  constexpr double kHalfLogTwoPi = 0.91893853320467274;
  constexpr double kLarge = 10;
  double product = 1;
  for (; x < kLarge; ++x)
    product *= x;
  const double inverse = 1 / x, square = inverse * inverse;
  const double series =
      inverse *
      (1.0 / 12 - square * (1.0 / 360 - square * (1.0 / 1260 - square / 1680)));
  return (x - 0.5) * portableLog(x) - x + kHalfLogTwoPi + series - portableLog(product);
}

double
logBeta(double a, double b)
{
  return logGamma(a) + logGamma(b) - logGamma(a + b);
}

/** log of the beta-binomial probability of k of n, but for the binomial coefficient. */
double
logBetaBinomial(double k, double n, double a, double b)
{
  return logBeta(k + a, n - k + b) - logBeta(a, b);
}

/** Log odds of a wrong link by what the rays contradict. */
double
raysAgainst(const SightEvidence& sight, double background)
{
  const auto n = static_cast<double>(sight.patches);
  const auto k = static_cast<double>(sight.contradicted_patches);
  const double a = background * kBackgroundPrecision;
  return logBetaBinomial(k, n, kWrongFree, kWrongConfirmed) -
         logBetaBinomial(k, n, a, kBackgroundPrecision - a);
}

/** Log odds of a shifted link by the way that the surfaces would move it: those of a normal
 * distribution against a wide one, even at so many standard deviations. */
double
surfacesAgainst(const LinkEvidence& evidence)
{
  const double sigmas = evidence.leaving() / evidence.deviation();
  return 0.5 * (sigmas * sigmas - kLeavingSigmas * kLeavingSigmas);
}

/** \return the probability of a hypothesis by its log odds, with the prior */
double
probabilityOf(double log_odds)
{
  constexpr double kMost = 700; // of a double
  const double odds = kPriorOdds * portableExp(std::min(log_odds, kMost));
  return odds / (1 + odds);
}

/** \return a number for people: two digits, and no powers of ten */
std::string
rounded(double value)
{
  std::ostringstream digits;
  if (value < 10)
    digits << std::setprecision(2) << value;
  else
    digits << std::fixed << std::setprecision(0) << value;
  return digits.str();
}

std::string
reasonOf(const LinkEvidence& evidence, double rays, double surfaces)
{
  std::ostringstream why;
  if (probabilityOf(rays) >= kGoodBelow && rays > surfaces &&
      evidence.sight.contradicted_patches > 0)
    why << "rays go through " << evidence.sight.contradicted_patches << " of "
        << evidence.sight.patches << " patches of surface";
  else if (probabilityOf(surfaces) >= kGoodBelow)
    why << "surfaces ask for a shift of " << rounded(evidence.leaving()) << " m, "
        << rounded(evidence.leaving() / evidence.deviation()) << " standard deviations";
  else if (evidence.fit.open_directions > 0)
    why << "the surfaces leave "
        << text::counted(static_cast<std::size_t>(evidence.fit.open_directions),
                         "motion")
        << " open, as along a corridor";
  else
    why << "only " << evidence.sight.patches << " patches of surface in common";
  return why.str();
}
} // namespace

double
LinkEvidence::deviation() const
{
  return std::max(kDeviationFactor * fit.deviation(), kResolution * voxel);
}

LinkEvidence
linkEvidence(const VerifiedScan& first,
             const VerifiedScan& second,
             const Eigen::Isometry3d& T_first_second,
             std::vector<Contradiction>* contradictions)
{
  LinkEvidence evidence;
  evidence.voxel = std::max(first.voxel(), second.voxel());
  evidence.abstained = first.abstains() || second.abstains();
  evidence.fit = settled(first, second, T_first_second, evidence.voxel);
  if (!first.abstains())
    evidence.sight += lookFrom(
        first, second, T_first_second, evidence.voxel, evidence.fit, contradictions);
  if (!second.abstains())
    evidence.sight += lookFrom(
        second, first, T_first_second.inverse(), evidence.voxel, evidence.fit, nullptr);
  return evidence;
}

LinkCheck
linkCheck(std::size_t from,
          std::size_t to,
          const LinkEvidence& evidence,
          const LinkOpinion& opinion)
{
  LinkCheck link;
  link.from = from;
  link.to = to;
  link.trust = opinion.trust;
  link.probability_wrong = opinion.probability_wrong;
  link.patches = evidence.sight.patches;
  link.contradicted = evidence.sight.contradicted_patches;
  link.shift = evidence.leaving();
  link.deviation = evidence.deviation();
  link.open_directions = evidence.fit.open_directions;
  link.reason = opinion.reason;
  return link;
}

std::vector<Contradiction>
contradictedPoints(const VerifiedScan& from,
                   const VerifiedScan& at,
                   const Eigen::Isometry3d& T_from_at)
{
  std::vector<Contradiction> points;
  const double voxel = std::max(from.voxel(), at.voxel());
  if (!from.abstains())
    lookFrom(from, at, T_from_at, voxel, settled(from, at, T_from_at, voxel), &points);
  return points;
}

double
contradictionBackground(const std::vector<LinkEvidence>& links)
{
  std::vector<const SightEvidence*> sights;
  for (const LinkEvidence& link : links)
    if (link.sight.patches > 0)
      sights.push_back(&link.sight);
  std::sort(
      sights.begin(), sights.end(), [](const SightEvidence* a, const SightEvidence* b) {
        return a->contradicted_patches * b->patches <
               b->contradicted_patches * a->patches;
      });
  double contradicted = kBackground * kBackgroundWeight, all = kBackgroundWeight;
  for (std::size_t i = 0; i < (sights.size() + 1) / 2; ++i) {
    contradicted += static_cast<double>(sights[i]->contradicted_patches);
    all += static_cast<double>(sights[i]->patches);
  }
  return std::clamp(contradicted / all, kLeastBackground, kMostBackground);
}

LinkOpinion
judgeLink(const LinkEvidence& evidence, double background)
{
  require(background > 0 && background < 1, "background", background, "in (0, 1)");
  const double rays = raysAgainst(evidence.sight, background);
  const double surfaces = surfacesAgainst(evidence);
  LinkOpinion opinion;
  // Elsewhere, which rays tell, or beside, which surfaces tell: neither speaks for the other.
  opinion.elsewhere = probabilityOf(rays);
  opinion.beside = probabilityOf(surfaces);
  opinion.probability_wrong = 1 - (1 - opinion.elsewhere) * (1 - opinion.beside);
  if (opinion.probability_wrong > kWrongAbove)
    opinion.trust = LinkTrust::kWrong;
  else if (evidence.fit.open_directions > 0)
    opinion.trust =
        LinkTrust::kWeak; // along these rays and surfaces cannot see an error
  else if (evidence.abstained && evidence.fit.spread > 0) // the surfaces speak
    opinion.trust = LinkTrust::kUnverified;
  else if (opinion.probability_wrong < kGoodBelow && !evidence.abstained &&
           evidence.sight.patches >= kLeastPatches &&
           evidence.sight.confirmation() >= kLeastConfirmation)
    opinion.trust = LinkTrust::kGood;
  if (opinion.trust == LinkTrust::kUnverified)
    opinion.reason =
        "a scan has too few surfaces, or its rays contradict its own points";
  else if (opinion.trust != LinkTrust::kGood)
    opinion.reason = reasonOf(evidence, rays, surfaces);
  return opinion;
}

} // namespace pcl6d
