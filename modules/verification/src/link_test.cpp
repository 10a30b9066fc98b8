// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "evidence_parts.h"

#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/verification/link_evidence.h>
#include <pcl6d/verification/ties.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using namespace verification;

namespace {
/** Stirling's series, within 1e-10 for x > 0; only + - * / are used, for equal bits. */
double
logGamma(double x)
{
  constexpr double kHalfLogTwoPi = 0.91893853320467274;
  constexpr double kLarge = 10;
  double product = 1;
  while (x < kLarge) {
    product *= x;
    x += 1;
  }
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

/** log of the beta-binomial probability of k of n, without the binomial coefficient. */
double
logBetaBinomial(double k, double n, double a, double b)
{
  return logBeta(k + a, n - k + b) - logBeta(a, b);
}

/** Log odds of a shifted link, from the shift required by the surfaces: a normal
 * distribution against a wide one, equal at the given number of standard deviations. */
double
surfacesAgainst(const LinkEvidence& evidence)
{
  const double sigmas = evidence.leaving() / evidence.deviation();
  return 0.5 * (sigmas * sigmas - kLeavingSigmas * kLeavingSigmas);
}

/** \return the probability of a hypothesis from its log odds, with the prior */
double
probabilityOf(double log_odds)
{
  constexpr double kMost = 700; // limit of exp() in double
  const double odds = kPriorOdds * portableExp(std::clamp(log_odds, -kMost, kMost));
  return odds / (1 + odds);
}

Rejection
rejectionOf(const LinkEvidence& evidence, double rays, double surfaces)
{
  const SightEvidence& sight = evidence.sight;
  const auto patches = static_cast<double>(sight.patches);
  const bool is_even =
      std::max(probabilityOf(rays), probabilityOf(surfaces)) < kGoodBelow;
  if (is_even && evidence.fit.spread == 0 && sight.patches >= kLeastPatches)
    return RejectReason::kNoSurfacesMeet;
  if (is_even && evidence.fit.open_directions > 0)
    return {RejectReason::kFreeDirections,
            static_cast<double>(evidence.fit.open_directions)};
  if (is_even && sight.patches >= kLeastPatches &&
      sight.confirmation() < kLeastConfirmation)
    return {RejectReason::kTooFewConfirmed, sight.confirmation(), kLeastConfirmation};
  if (rays > surfaces && sight.contradicted_patches > 0)
    return {RejectReason::kPatchesViolated,
            static_cast<double>(sight.contradicted_patches),
            patches};
  if (sight.patches < kLeastPatches && rays > surfaces)
    return {RejectReason::kTooFewPatches, patches, static_cast<double>(kLeastPatches)};
  return {RejectReason::kShifted, evidence.leaving(), evidence.deviation()};
}
} // namespace

namespace verification {
RaysAgainst
raysAgainst(std::size_t contradicted, std::size_t patches, const RightLinks& usual)
{
  const auto n = static_cast<double>(patches), k = static_cast<double>(contradicted);
  const auto rightWith = [&](double share) {
    return logBetaBinomial(
        k, n, share * usual.precision, (1 - share) * usual.precision);
  };
  // A link without contradictions never indicates another pose, whatever the background.
  const double right = std::max(rightWith(usual.background),
                                rightWith(std::min(usual.background, usual.least)));
  return {logBetaBinomial(k, n, kWrongFree, kWrongConfirmed) - right,
          logBetaBinomial(k, n, kEvenFree, kEvenConfirmed) - right};
}

double
logRatioOf(const RaysAgainst& against, double even_share)
{
  constexpr double kLeast = -700; // limit of exp() in double
  const double more = std::max(against.usual, against.even);
  return more +
         portableLog((1 - even_share) *
                         portableExp(std::max(against.usual - more, kLeast)) +
                     even_share * portableExp(std::max(against.even - more, kLeast)));
}

double
probabilityOf(const RaysAgainst& against, double even_share)
{
  return pcl6d::probabilityOf(logRatioOf(against, even_share));
}
} // namespace verification

namespace {
/** \return the links with common patches, the least contradicted first */
std::vector<const SightEvidence*>
leastContradictedFirst(const std::vector<LinkEvidence>& links)
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
  return sights;
}
} // namespace

double
contradictionBackground(const std::vector<LinkEvidence>& links)
{
  const std::vector<const SightEvidence*> sights = leastContradictedFirst(links);
  if (sights.size() < 2) // a single link gives no background
    return kBackground;
  double contradicted = kBackground * kBackgroundPrecision, all = kBackgroundPrecision;
  const auto background = [&] {
    return std::max(contradicted / all, kLeastBackground);
  };
  for (std::size_t i = 0; i < (sights.size() + 1) / 2; ++i) {
    // Links wrong by the background of better links are no right links: of three scans, one at a
    // wrong place, the better half has one of them.
    if (i > 0 &&
        probabilityOf(
            raysAgainst(sights[i]->contradicted_patches,
                        sights[i]->patches,
                        {background(), kLeastBackground, kBackgroundPrecision}),
            kEvenShare) > kWrongAbove)
      break;
    // The patches of a link share their causes: each counts less in a link with many.
    const auto n = static_cast<double>(sights[i]->patches);
    const double weight = kBackgroundPrecision / (kBackgroundPrecision + n);
    contradicted += weight * static_cast<double>(sights[i]->contradicted_patches);
    all += weight * n;
  }
  return background() > kNoBackground ? kBackground : background();
}

LinkTestResult
testLink(const LinkEvidence& evidence, double background)
{
  require(background > 0 && background < 1, "background", background, "in (0, 1)");
  const double rays =
      logRatioOf(raysAgainst(evidence.sight.contradicted_patches,
                             evidence.sight.patches,
                             {background, kLeastBackground, kBackgroundPrecision}),
                 kEvenShare);
  const double surfaces = surfacesAgainst(evidence);
  LinkTestResult test_result;
  // Rays detect a different pose, surfaces a small shift: independent questions.
  test_result.elsewhere = probabilityOf(rays);
  test_result.beside = probabilityOf(surfaces);
  test_result.probability_wrong =
      1 - (1 - test_result.elsewhere) * (1 - test_result.beside);
  const bool is_silent = evidence.abstained || background > kMostBackground;
  if (test_result.probability_wrong > kWrongAbove)
    test_result.trust = LinkTrust::kWrong;
  else if (evidence.fit.open_directions > 0)
    test_result.trust =
        LinkTrust::kWeak; // an error along the open motion would not be detected
  else if (is_silent && evidence.fit.spread > 0 && test_result.beside < kGoodBelow)
    test_result.trust = LinkTrust::kUnverified; // only the surface test is left
  else if (test_result.probability_wrong < kGoodBelow && !is_silent &&
           evidence.fit.spread > 0 && evidence.sight.patches >= kLeastPatches &&
           evidence.sight.confirmation() >= kLeastConfirmation)
    test_result.trust = LinkTrust::kGood;
  if (test_result.trust == LinkTrust::kUnverified)
    test_result.rejection = evidence.off_centre  ? RejectReason::kOffCentre
                            : evidence.abstained ? RejectReason::kTooFewSurfaces
                                                 : RejectReason::kRaysUnreliable;
  else if (test_result.trust != LinkTrust::kGood)
    test_result.rejection = rejectionOf(evidence, rays, surfaces);
  return test_result;
}

} // namespace pcl6d
