// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "verification_fit.h"

#include <pcl6d/verification/ties.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <ostream>

namespace pcl6d::bench {

namespace {
using Links = std::vector<const EvaluatedLink*>;

bool
isRight(const EvaluatedLink& link)
{
  return link.kind == "right" || link.kind == "truth";
}

bool
isElsewhere(const EvaluatedLink& link)
{
  return link.kind == "minimum" || link.kind == "fold" || link.kind == "apart";
}

/** \return whether it is a known shift or turn that must be noticed */
bool
isShifted(const EvaluatedLink& link)
{
  constexpr double kLeast = 0.05; // [m]
  const double way =
      std::hypot(link.off, link.turn * link.evidence.fit.spread * std::sqrt(2.0 / 3));
  return !isRight(link) && !isElsewhere(link) &&
         way > std::max(kLeast, 3 * link.evidence.deviation());
}

std::vector<std::string>
groupsOf(const std::vector<EvaluatedLink>& links)
{
  std::vector<std::string> groups;
  for (const EvaluatedLink& link : links)
    if (std::find(groups.begin(), groups.end(), link.group) == groups.end())
      groups.push_back(link.group);
  return groups;
}

Links
linksWhere(const std::vector<EvaluatedLink>& links,
           const std::function<bool(const EvaluatedLink&)>& holds)
{
  Links found;
  for (const EvaluatedLink& link : links)
    if (holds(link))
      found.push_back(&link);
  return found;
}

std::size_t
countOf(const Links& links, const std::function<bool(const EvaluatedLink&)>& holds)
{
  return static_cast<std::size_t>(
      std::count_if(links.begin(), links.end(), [&](const EvaluatedLink* link) {
        return holds(*link);
      }));
}

/** Share of the patches that rays contradict in right links and at other places; by default the
 * constants in use. */
struct ContradictionFit {
  double background = verification::kBackground; ///< mean of right links
  /** parameters of the beta distribution at other places */
  double free = verification::kWrongFree, confirmed = verification::kWrongConfirmed;
};

double
shareOf(const EvaluatedLink& link)
{
  const SightEvidence& sight = link.evidence.sight;
  return static_cast<double>(sight.contradicted_patches) /
         static_cast<double>(std::max<std::size_t>(1, sight.patches));
}

/** Moments of links with enough patches to tell a share. */
ContradictionFit
fitOf(const Links& links)
{
  double right = 0, wrong = 0, wrong_sq = 0, num_right = 0, num_wrong = 0;
  for (const EvaluatedLink* link : links) {
    if (link->evidence.sight.patches < verification::kLeastPatches)
      continue;
    const double share = shareOf(*link);
    if (isRight(*link)) {
      right += share;
      ++num_right;
    }
    else if (isElsewhere(*link)) {
      wrong += share;
      wrong_sq += share * share;
      ++num_wrong;
    }
  }
  ContradictionFit fit;
  fit.background =
      std::max(verification::kLeastBackground, right / std::max(1.0, num_right));
  const double mean = wrong / std::max(1.0, num_wrong);
  const double variance =
      std::max(1e-6, wrong_sq / std::max(1.0, num_wrong) - mean * mean);
  const double precision = std::max(1.0, mean * (1 - mean) / variance - 1);
  fit.free = mean * precision;
  fit.confirmed = (1 - mean) * precision;
  return fit;
}

double
logBetaBinomial(double k, double n, double a, double b)
{
  const auto logBeta = [](double x, double y) {
    return std::lgamma(x) + std::lgamma(y) - std::lgamma(x + y);
  };
  return logBeta(k + a, n - k + b) - logBeta(a, b);
}

/** \return the probability that a link belongs elsewhere, by rays, as testLink() has it */
double
elsewhereBy(const ContradictionFit& fit, const EvaluatedLink& link)
{
  using namespace verification;
  const auto n = static_cast<double>(link.evidence.sight.patches);
  const auto k = static_cast<double>(link.evidence.sight.contradicted_patches);
  const auto rightWith = [&](double share) {
    return logBetaBinomial(
        k, n, share * kBackgroundPrecision, (1 - share) * kBackgroundPrecision);
  };
  const double right = std::max(rightWith(fit.background),
                                rightWith(std::min(fit.background, kLeastBackground)));
  const auto oddsOf = [&](double free, double confirmed) {
    constexpr double kMost = 700; // limit of exp() in double
    return std::exp(std::min(kMost, logBetaBinomial(k, n, free, confirmed) - right));
  };
  const double odds = kPriorOdds * ((1 - kEvenShare) * oddsOf(fit.free, fit.confirmed) +
                                    kEvenShare * oddsOf(kEvenFree, kEvenConfirmed));
  return odds / (1 + odds);
}

/** \return whether the ray test alone calls a link good */
bool
isGoodBy(const ContradictionFit& fit, const EvaluatedLink& link)
{
  return elsewhereBy(fit, link) < verification::kGoodBelow &&
         link.evidence.sight.patches >= verification::kLeastPatches;
}

/** \return the value that a share of the values exceeds; 0 without values */
double
exceededBy(double share, std::vector<double> values)
{
  if (values.empty())
    return 0;
  std::sort(values.begin(), values.end());
  const auto below =
      static_cast<std::size_t>((1 - share) * static_cast<double>(values.size()));
  return values[std::min(below, values.size() - 1)];
}

/** \return the limit of a score (more is better) that doubts 3 % of right links */
double
limitOf(const Links& links, const std::function<double(const EvaluatedLink&)>& score)
{
  std::vector<double> scores;
  for (const EvaluatedLink* link : links)
    if (isRight(*link))
      scores.push_back(score(*link));
  if (scores.empty())
    return 0;
  std::sort(scores.begin(), scores.end());
  return scores[static_cast<std::size_t>(0.03 * static_cast<double>(scores.size()))];
}

std::string
ratio(std::size_t count, std::size_t of)
{
  return std::to_string(count) + " / " + std::to_string(of);
}

/** The links of a group, and those of all other groups. */
struct LeftOut {
  LeftOut(const std::vector<EvaluatedLink>& all, const std::string& group)
  : others(linksWhere(all, [&](const auto& l) { return l.group != group; }))
  , right(
        linksWhere(all, [&](const auto& l) { return l.group == group && isRight(l); }))
  , wrong(linksWhere(all,
                     [&](const auto& l) { return l.group == group && isElsewhere(l); }))
  , shifted(linksWhere(all,
                       [&](const auto& l) { return l.group == group && isShifted(l); }))
  {}

  Links others, right, wrong, shifted;
};

void
printLeftOut(const std::string& group, const LeftOut& links, std::ostream& out)
{
  const ContradictionFit fit = fitOf(links.others), in_use;
  const auto numberGood = [&](const ContradictionFit& by) {
    return countOf(links.wrong, [&](const auto& l) { return isGoodBy(by, l); });
  };
  const auto numberDoubted = [&](const ContradictionFit& by) {
    return countOf(links.right, [&](const auto& l) {
      return elsewhereBy(by, l) > verification::kWrongAbove;
    });
  };
  const auto overlap = [](const EvaluatedLink& l) { return l.evidence.fit.overlap; };
  const auto rms = [](const EvaluatedLink& l) {
    return -l.evidence.fit.residual / l.evidence.voxel;
  };
  const double least = limitOf(links.others, overlap),
               most = limitOf(links.others, rms);
  out << "| " << group << " | " << std::setprecision(3) << fitOf(links.right).background
      << " | " << fit.background << " | " << fit.free << ", " << fit.confirmed << " | "
      << numberDoubted(fit) << " | " << ratio(numberDoubted(in_use), links.right.size())
      << " | " << numberGood(fit) << " | "
      << ratio(numberGood(in_use), links.wrong.size()) << " | "
      << countOf(links.wrong, [&](const auto& l) { return overlap(l) >= least; })
      << " | " << countOf(links.wrong, [&](const auto& l) { return rms(l) >= most; })
      << " |\n";
}

/** \return the shift that the surfaces of a link require, in standard deviations */
double
sigmasOf(const EvaluatedLink& link)
{
  return link.evidence.leaving() / link.evidence.deviation();
}

void
printShiftsLeftOut(const std::string& group, const LeftOut& links, std::ostream& out)
{
  constexpr double kShare = 0.005;
  // kLeavingSigmas with the limits of the probability, see surfacesAgainst().
  const auto sigmasAt = [](double probability) {
    const double log_odds =
        std::log(probability / (1 - probability) / verification::kPriorOdds);
    return std::sqrt(std::pow(verification::kLeavingSigmas, 2) + 2 * log_odds);
  };
  const double good = sigmasAt(verification::kGoodBelow),
               wrong = sigmasAt(verification::kWrongAbove);
  std::vector<double> others;
  for (const EvaluatedLink* link : links.others)
    if (isRight(*link) && link->evidence.fit.open_directions == 0)
      others.push_back(sigmasOf(*link));
  const double fitted = exceededBy(kShare, others);
  const auto above = [&](double limit) {
    return countOf(links.right, [&](const auto& l) {
      return l.evidence.fit.open_directions == 0 && sigmasOf(l) > limit;
    });
  };
  const auto below = [&](double limit) {
    return countOf(links.shifted, [&](const auto& l) { return sigmasOf(l) < limit; });
  };
  out << "| " << group << " | " << std::setprecision(3) << fitted << " | "
      << above(fitted) << " | " << above(good) << " | "
      << ratio(above(wrong), links.right.size()) << " | " << below(fitted) << " | "
      << ratio(below(good), links.shifted.size()) << " |\n";
}
} // namespace

void
printVerdicts(const std::vector<EvaluatedLink>& links, std::ostream& out)
{
  out << "| set or sensor | right: good / weak / wrong | other places: good / of | "
         "wrong "
         "shifts and turns called good / of |\n|---|---|---|---|\n";
  for (const std::string& group : groupsOf(links)) {
    const auto with = [](LinkTrust trust) {
      return [trust](const EvaluatedLink& l) { return l.trust == trust; };
    };
    const LeftOut of(links, group);
    const std::size_t good = countOf(of.right, with(LinkTrust::kGood));
    const std::size_t doubted = countOf(of.right, with(LinkTrust::kWrong));
    out << "| " << group << " | " << good << " / " << of.right.size() - good - doubted
        << " / " << doubted << " | "
        << ratio(countOf(of.wrong, with(LinkTrust::kGood)), of.wrong.size()) << " | "
        << ratio(countOf(of.shifted, with(LinkTrust::kGood)), of.shifted.size())
        << " |\n";
  }
}

void
printLeaveOneOut(const std::vector<EvaluatedLink>& links, std::ostream& out)
{
  const std::vector<std::string> groups = groupsOf(links);
  if (groups.size() < 2)
    return;
  out << "| left out | its background | background of the others | wrong: beta | right "
         "doubted: fitted | in use / of | other places good by rays: fitted | in use / "
         "of "
         "| by overlap | by rms |\n|---|---|---|---|---|---|---|---|---|---|\n";
  for (const std::string& group : groups)
    printLeftOut(group, LeftOut(links, group), out);
}

void
printShiftLimits(const std::vector<EvaluatedLink>& links, std::ostream& out)
{
  const std::vector<std::string> groups = groupsOf(links);
  if (groups.size() < 2)
    return;
  out << "| left out | limit [deviations] of the others | right above: fitted | above "
         "the limit of good | above the limit of wrong / of | shifted below: fitted | "
         "below the limit of good / of |\n|---|---|---|---|---|---|---|\n";
  for (const std::string& group : groups)
    printShiftsLeftOut(group, LeftOut(links, group), out);
}

} // namespace pcl6d::bench
