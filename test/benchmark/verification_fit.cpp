// SPDX-License-Identifier: BSD-3-Clause
#include "verification_fit.h"

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
setsOf(const std::vector<EvaluatedLink>& links)
{
  std::vector<std::string> sets;
  for (const EvaluatedLink& link : links)
    if (std::find(sets.begin(), sets.end(), link.set) == sets.end())
      sets.push_back(link.set);
  return sets;
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

/** What rays contradict in right links and at other places. */
struct ContradictionFit {
  double background = 0;  ///< mean share of right links
  double free, confirmed; ///< parameters of the beta distribution at other places
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
  constexpr std::size_t kTelling = 30; // patches
  double right = 0, wrong = 0, wrong_sq = 0, num_right = 0, num_wrong = 0;
  for (const EvaluatedLink* link : links) {
    if (link->evidence.sight.patches < kTelling)
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
  fit.background = std::max(0.002, right / std::max(1.0, num_right));
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

/** \return the probability that a link belongs elsewhere, by a fit */
double
elsewhereBy(const ContradictionFit& fit, const EvaluatedLink& link)
{
  constexpr double kPrecision = 40, kPriorOdds = 0.1; // as calibration.h
  const auto n = static_cast<double>(link.evidence.sight.patches);
  const auto k = static_cast<double>(link.evidence.sight.contradicted_patches);
  const double right = logBetaBinomial(
      k, n, fit.background * kPrecision, (1 - fit.background) * kPrecision);
  const double odds =
      kPriorOdds *
      std::exp(std::min(700.0, logBetaBinomial(k, n, fit.free, fit.confirmed) - right));
  return odds / (1 + odds);
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

void
printLeftOut(const std::vector<EvaluatedLink>& all,
             const std::string& set,
             std::ostream& out)
{
  const Links others = linksWhere(all, [&](const auto& l) { return l.set != set; });
  const Links right =
      linksWhere(all, [&](const auto& l) { return l.set == set && isRight(l); });
  const Links wrong =
      linksWhere(all, [&](const auto& l) { return l.set == set && isElsewhere(l); });
  const ContradictionFit fit = fitOf(others);
  const auto isGood = [&](const EvaluatedLink& l) {
    return elsewhereBy(fit, l) < 0.01 && l.evidence.sight.patches >= 30;
  };
  const auto isDoubted = [&](const EvaluatedLink& l) {
    return elsewhereBy(fit, l) > 0.9;
  };
  const auto overlap = [](const EvaluatedLink& l) { return l.evidence.fit.overlap; };
  const auto rms = [](const EvaluatedLink& l) {
    return -l.evidence.fit.residual / l.evidence.voxel;
  };
  const double least = limitOf(others, overlap), most = limitOf(others, rms);
  out << "| " << set << " | " << std::setprecision(3) << fit.background << " | "
      << fit.free << ", " << fit.confirmed << " | "
      << ratio(countOf(right, isDoubted), right.size()) << " | "
      << ratio(countOf(wrong, isGood), wrong.size()) << " | "
      << countOf(wrong, [&](const auto& l) { return overlap(l) >= least; }) << " | "
      << countOf(wrong, [&](const auto& l) { return rms(l) >= most; }) << " |\n";
}
} // namespace

void
printVerdicts(const std::vector<EvaluatedLink>& links, std::ostream& out)
{
  out << "| set | right: good / weak / wrong | other places: good / of | wrong shifts "
         "and "
         "turns called good / of |\n|---|---|---|---|\n";
  for (const std::string& set : setsOf(links)) {
    const auto of = [&](const auto& holds) {
      return linksWhere(links, [&](const auto& l) { return l.set == set && holds(l); });
    };
    const auto with = [](LinkTrust trust) {
      return [trust](const EvaluatedLink& l) { return l.trust == trust; };
    };
    const Links right = of(isRight), wrong = of(isElsewhere), shifted = of(isShifted);
    const std::size_t good = countOf(right, with(LinkTrust::kGood));
    const std::size_t doubted = countOf(right, with(LinkTrust::kWrong));
    out << "| " << set << " | " << good << " / " << right.size() - good - doubted
        << " / " << doubted << " | "
        << ratio(countOf(wrong, with(LinkTrust::kGood)), wrong.size()) << " | "
        << ratio(countOf(shifted, with(LinkTrust::kGood)), shifted.size()) << " |\n";
  }
}

void
printLeaveOneOut(const std::vector<EvaluatedLink>& links, std::ostream& out)
{
  const std::vector<std::string> sets = setsOf(links);
  if (sets.size() < 2)
    return;
  out << "| left out | background of the others | wrong: beta | right doubted | other "
         "places good by rays | by overlap | by rms |\n|---|---|---|---|---|---|---|\n";
  for (const std::string& set : sets)
    printLeftOut(links, set, out);
}

} // namespace pcl6d::bench
