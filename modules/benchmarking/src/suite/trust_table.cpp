// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/benchmarking/trust_table.h>
#include <pcl6d/common/error.h>

#include <boost/math/distributions/binomial.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

namespace pcl6d {

namespace {
constexpr double kLeastAllowedError = 0.05; // [m] no map is called wrong for less
constexpr double kChiSquare95 = 7.815;      // quantiles with 3 degrees of freedom
constexpr double kChiSquare999 = 16.27;
constexpr double kRisk = 0.05; // of an upper bound
constexpr double kBoundSizes[] = {0.01,
                                  0.02,
                                  0.05, // [m] of the rows of bounds
                                  0.1,
                                  0.2,
                                  0.5};
constexpr double kEndless = std::numeric_limits<double>::infinity();

double
bound999(double bound95)
{
  return bound95 * std::sqrt(kChiSquare999 / kChiSquare95);
}

bool
isOff(const TrustScan& scan)
{
  return scan.error > allowedError(scan);
}

void
countRun(const TrustRun& run, TrustCounts& counts)
{
  ++counts.runs;
  if (run.call == TrustCall::kNone || run.scans.empty()) {
    ++(run.call == TrustCall::kNone ? counts.failed : counts.without_truth);
    return;
  }
  const bool good = run.call == TrustCall::kGood;
  const bool unverified = run.call == TrustCall::kUnverified;
  const bool doubted = run.call == TrustCall::kDoubted;
  const bool wrong = isWrong(run), right = isRight(run);
  counts.good += good;
  counts.unverified += unverified;
  counts.doubted += doubted;
  counts.wrong += wrong;
  counts.right += right;
  counts.false_goods.of += good;
  counts.false_goods.count += good && wrong;
  counts.missed.of += wrong;
  counts.missed.count += good && wrong;
  counts.false_unverified.of += unverified;
  counts.false_unverified.count += unverified && wrong;
  const bool verified = good || (doubted && run.doubted_by_matching);
  counts.false_verifications.of += verified;
  counts.false_verifications.count += verified && !right;
  counts.false_doubts.of += right;
  counts.false_doubts.count += doubted && right;
  counts.by_matching += doubted && right && run.doubted_by_matching;
}

/** Counts of runs, grouped by a key. */
class CountsBy {
public:
  using Key = std::function<TrustCounts(const TrustRun&)>;

  /** \param[in] key returns the group of a run */
  explicit CountsBy(Key key) : key_(std::move(key)) {}

  void
  add(const TrustRun& run)
  {
    const TrustCounts named = key_(run);
    const auto [place, is_new] = places_.emplace(
        std::vector<std::string>{named.data, named.damage, named.method}, rows_.size());
    if (is_new)
      rows_.push_back(named);
    countRun(run, rows_[place->second]);
  }

  std::vector<TrustCounts>
  take()
  {
    return std::move(rows_);
  }

private:
  Key key_;
  std::map<std::vector<std::string>, std::size_t> places_;
  std::vector<TrustCounts> rows_;
};

TrustCounts
countsNamed(const std::string& data,
            const std::string& damage,
            const std::string& method)
{
  TrustCounts counts;
  counts.data = data;
  counts.damage = damage;
  counts.method = method;
  return counts;
}

std::vector<TrustCounts>
countsBy(const std::vector<TrustRun>& runs, const CountsBy::Key& key)
{
  CountsBy counts(key);
  for (const TrustRun& run : runs)
    counts.add(run);
  return counts.take();
}

/** Calls take with the scans that a map claims to be right. */
template <typename Take>
void
forEachClaim(const TrustRun& run, const Take& take)
{
  bool is_origin = true; // the first scan not named: origin of the errors
  for (const TrustScan& scan : run.scans) {
    if (scan.named || !std::isfinite(scan.error))
      continue;
    if (!is_origin)
      take(scan);
    is_origin = false;
  }
}

/** A row of bounds up to a size, from the list of (bound, error). */
BoundCounts
boundsBetween(double above,
              double up_to,
              const std::vector<std::pair<double, double>>& claims)
{
  BoundCounts row{above, up_to};
  std::vector<double> ratios;
  for (const auto& [bound, error] : claims) {
    if (bound <= above || bound > up_to)
      continue;
    ++row.scans;
    row.within += error <= bound;
    row.within_999 += error <= bound999(bound);
    ratios.push_back(error / bound);
  }
  if (!ratios.empty()) {
    const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
    std::nth_element(ratios.begin(), middle, ratios.end());
    row.median_ratio = *middle;
  }
  return row;
}

std::vector<BoundCounts>
boundsOf(const std::vector<TrustRun>& runs)
{
  std::vector<std::pair<double, double>> claims;
  for (const TrustRun& run : runs)
    if (run.call == TrustCall::kGood)
      forEachClaim(run, [&](const TrustScan& scan) {
        if (scan.bound)
          claims.emplace_back(*scan.bound, scan.error);
      });
  std::vector<BoundCounts> rows;
  double above = 0;
  for (const double size : kBoundSizes) {
    rows.push_back(boundsBetween(above, size, claims));
    above = size;
  }
  rows.push_back(boundsBetween(above, kEndless, claims));
  rows.erase(std::remove_if(rows.begin(),
                            rows.end(),
                            [](const BoundCounts& row) { return row.scans == 0; }),
             rows.end());
  return rows;
}

SquaredErrors
squaredErrorsOf(const std::vector<TrustRun>& runs)
{
  SquaredErrors errors;
  double sum = 0;
  for (const TrustRun& run : runs)
    if (run.call == TrustCall::kGood && !isWrong(run))
      forEachClaim(run, [&](const TrustScan& scan) {
        if (scan.squared_error) {
          ++errors.scans;
          sum += *scan.squared_error / 3;
        }
      });
  if (errors.scans > 0)
    errors.mean = sum / static_cast<double>(errors.scans);
  return errors;
}
} // namespace

const char*
toString(TrustCall call)
{
  switch (call) {
  case TrustCall::kGood:
    return "good";
  case TrustCall::kUnverified:
    return "unverified";
  case TrustCall::kDoubted:
    return "doubted";
  case TrustCall::kNone:
    return "none";
  }
  return "";
}

double
allowedError(const TrustScan& scan)
{
  return std::max(kLeastAllowedError, scan.bound ? bound999(*scan.bound) : 0.0);
}

bool
isWrong(const TrustRun& run)
{
  return std::any_of(run.scans.begin(), run.scans.end(), [](const TrustScan& scan) {
    return !scan.named && isOff(scan);
  });
}

bool
isRight(const TrustRun& run)
{
  return !run.scans.empty() && std::none_of(run.scans.begin(), run.scans.end(), isOff);
}

double
largestUnnamedError(const TrustRun& run)
{
  double largest = 0;
  for (const TrustScan& scan : run.scans)
    if (!scan.named)
      largest = std::max(largest, scan.error);
  return largest;
}

double
TrustShare::rate() const
{
  return of > 0 ? static_cast<double>(count) / static_cast<double>(of) : 0;
}

double
TrustShare::upperBound() const
{
  if (count > of)
    throw BadArgument("count = " + std::to_string(count) +
                      ", but must be <= " + std::to_string(of));
  if (count == of)
    return 1;
  return boost::math::binomial_distribution<>::find_upper_bound_on_p(
      static_cast<double>(of), static_cast<double>(count), kRisk);
}

TrustTable
trustTable(const std::vector<TrustRun>& runs)
{
  TrustTable table;
  for (const TrustRun& run : runs)
    countRun(run, table.all);
  table.by_damage = countsBy(
      runs, [](const TrustRun& run) { return countsNamed("", run.damage, ""); });
  table.by_data =
      countsBy(runs, [](const TrustRun& run) { return countsNamed(run.data, "", ""); });
  table.by_method = countsBy(
      runs, [](const TrustRun& run) { return countsNamed("", "", run.method); });
  table.cells = countsBy(runs, [](const TrustRun& run) {
    return countsNamed(run.data, run.damage, run.method);
  });
  table.bounds = boundsOf(runs);
  table.squared_errors = squaredErrorsOf(runs);
  return table;
}

} // namespace pcl6d
