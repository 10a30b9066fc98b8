// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "evidence_parts.h"

#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/io/text.h>
#include <pcl6d/verification/link_evidence.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace pcl6d {
using namespace verification;

namespace {
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
  const double odds = kPriorOdds * portableExp(std::clamp(log_odds, -kMost, kMost));
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
  const SightEvidence& sight = evidence.sight;
  const bool is_even =
      std::max(probabilityOf(rays), probabilityOf(surfaces)) < kGoodBelow;
  if (is_even && evidence.fit.spread == 0 && sight.patches >= kLeastPatches)
    why << "no surfaces meet";
  else if (is_even && evidence.fit.open_directions > 0)
    why << "the surfaces leave "
        << text::counted(static_cast<std::size_t>(evidence.fit.open_directions),
                         "motion")
        << " open, as along a corridor";
  else if (is_even && sight.patches >= kLeastPatches &&
           sight.confirmation() < kLeastConfirmation)
    why << "rays confirm only " << rounded(100 * sight.confirmation())
        << " % of the points";
  else if (rays > surfaces && sight.contradicted_patches > 0)
    why << "rays go through " << sight.contradicted_patches << " of " << sight.patches
        << " patches of surface";
  else if (sight.patches < kLeastPatches && rays > surfaces)
    why << "only " << sight.patches << " patches of surface in common";
  else
    why << "surfaces ask for a shift of " << rounded(evidence.leaving()) << " m, "
        << rounded(evidence.leaving() / evidence.deviation()) << " standard deviations";
  return why.str();
}
} // namespace

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
  if (sights.size() < 2) // a link is no judge of itself
    return kBackground;
  // However many its patches are, a link tells one share of many: it weighs as such.
  double contradicted = kBackground * kBackgroundPrecision, all = kBackgroundPrecision;
  for (std::size_t i = 0; i < (sights.size() + 1) / 2; ++i) {
    const auto n = static_cast<double>(sights[i]->patches);
    const double weight = kBackgroundPrecision / (kBackgroundPrecision + n);
    contradicted += weight * static_cast<double>(sights[i]->contradicted_patches);
    all += weight * n;
  }
  const double background = contradicted / all;
  return background > kNoBackground ? kBackground
                                    : std::max(background, kLeastBackground);
}

namespace verification {
RaysAgainst
raysAgainst(std::size_t contradicted,
            std::size_t patches,
            double background,
            double precision)
{
  const auto n = static_cast<double>(patches), k = static_cast<double>(contradicted);
  const auto rightWith = [&](double share) {
    return logBetaBinomial(k, n, share * precision, (1 - share) * precision);
  };
  // Nothing contradicted is never a sign of another place, however dirty the others are.
  const double right = std::max(rightWith(background),
                                rightWith(std::min(background, kLeastBackground)));
  return {logBetaBinomial(k, n, kWrongFree, kWrongConfirmed) - right,
          logBetaBinomial(k, n, kEvenFree, kEvenConfirmed) - right};
}

double
logRatioOf(const RaysAgainst& against)
{
  constexpr double kLeast = -700; // of a double
  const double more = std::max(against.usual, against.even);
  return more +
         portableLog((1 - kEvenShare) *
                         portableExp(std::max(against.usual - more, kLeast)) +
                     kEvenShare * portableExp(std::max(against.even - more, kLeast)));
}

double
probabilityOf(const RaysAgainst& against)
{
  return pcl6d::probabilityOf(logRatioOf(against));
}
} // namespace verification

LinkOpinion
judgeLink(const LinkEvidence& evidence, double background)
{
  require(background > 0 && background < 1, "background", background, "in (0, 1)");
  const double rays = logRatioOf(raysAgainst(evidence.sight.contradicted_patches,
                                             evidence.sight.patches,
                                             background,
                                             kBackgroundPrecision));
  const double surfaces = surfacesAgainst(evidence);
  LinkOpinion opinion;
  // Elsewhere, which rays tell, or beside, which surfaces tell: neither speaks for the other.
  opinion.elsewhere = probabilityOf(rays);
  opinion.beside = probabilityOf(surfaces);
  opinion.probability_wrong = 1 - (1 - opinion.elsewhere) * (1 - opinion.beside);
  const bool is_silent = evidence.abstained || background > kMostBackground;
  if (opinion.probability_wrong > kWrongAbove)
    opinion.trust = LinkTrust::kWrong;
  else if (evidence.fit.open_directions > 0)
    opinion.trust =
        LinkTrust::kWeak; // along these rays and surfaces cannot see an error
  else if (is_silent && evidence.fit.spread > 0 && opinion.beside < kGoodBelow)
    opinion.trust = LinkTrust::kUnverified; // the surfaces alone speak
  else if (opinion.probability_wrong < kGoodBelow && !is_silent &&
           evidence.fit.spread > 0 && evidence.sight.patches >= kLeastPatches &&
           evidence.sight.confirmation() >= kLeastConfirmation)
    opinion.trust = LinkTrust::kGood;
  if (opinion.trust == LinkTrust::kUnverified)
    opinion.reason =
        evidence.abstained
            ? "a scan has too few surfaces, or its rays contradict its own points"
            : "rays contradict too much even where the scans of this map fit best";
  else if (opinion.trust != LinkTrust::kGood)
    opinion.reason = reasonOf(evidence, rays, surfaces);
  return opinion;
}

} // namespace pcl6d
