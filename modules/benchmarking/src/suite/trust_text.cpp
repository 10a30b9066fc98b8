// SPDX-License-Identifier: BSD-3-Clause
#include "suite/table_text.h"

#include <pcl6d/benchmarking/trust_table.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
using TrustJson = nlohmann::ordered_json;
using benchmarking::cellOf;
using benchmarking::csvField;
using benchmarking::fixedText;

constexpr std::size_t kMostListedRuns = 40; // that are listed

std::string
cell(const std::string& text)
{
  return ' ' + cellOf(text) + " |";
}

std::string
cell(std::size_t number)
{
  return ' ' + std::to_string(number) + " |";
}

/** \return "3 (<= 4.2 %)": the count, and the upper bound of its probability */
std::string
shareText(const TrustShare& share)
{
  std::string text = std::to_string(share.count);
  if (share.of > 0)
    text += " (<= " + fixedText(100 * share.upperBound(), 1) + " %)";
  return text;
}

/** A table of counts. \param[in] head names of the leading columns
 * \param[in] names of a row, one per leading column */
template <typename Names>
std::string
countsMarkdown(const std::vector<TrustCounts>& rows,
               const std::vector<std::string>& head,
               const Names& names)
{
  std::string text = "|", rule = "|";
  for (const auto& title : head) {
    text += cell(title);
    rule += "---|";
  }
  text += " runs | no map | good | unverified | doubted | wrong | **false good** | "
          "wrong, unverified | off though verified | right | false doubt | "
          "of these by matching |\n" +
          rule + "---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const TrustCounts& row : rows) {
    text += '|';
    for (const std::string& name : names(row))
      text += cell(name);
    text += cell(row.runs) + cell(row.failed + row.without_truth) + cell(row.good) +
            cell(row.unverified) + cell(row.doubted) + cell(row.wrong) +
            cell(shareText(row.false_goods)) + cell(row.false_unverified.count) +
            cell(shareText(row.false_verifications)) + cell(row.right) +
            cell(shareText(row.false_doubts)) + cell(row.by_matching) + '\n';
  }
  return text + '\n';
}

std::string
describe(const TrustRun& run)
{
  const std::string text = "- " + run.name + ": ";
  const bool is_doubted = run.call == TrustCall::kDoubted;
  const std::string said = is_doubted ? run.message : "";
  const TrustScan* worst = nullptr;
  for (const TrustScan& scan : run.scans)
    if ((is_doubted || !scan.named) && scan.error > allowedError(scan) &&
        (worst == nullptr || scan.error > worst->error))
      worst = &scan;
  if (worst == nullptr)
    return text + said + '\n';
  const std::string name = text + worst->name,
                    end = said.empty() ? "" : "; said: " + said;
  if (!std::isfinite(worst->error))
    return name + " has no true place" + end + '\n';
  return name + " off by " + fixedText(worst->error, 3) + " m, allowed " +
         fixedText(allowedError(*worst), 3) + " m" +
         (worst->bound ? "" : " (no bound is stated)") + end + '\n';
}

/** A list of the selected runs, the largest errors first. */
template <typename Is>
std::string
listOf(const std::string& title, const std::vector<TrustRun>& runs, const Is& is)
{
  std::vector<const TrustRun*> chosen;
  for (const TrustRun& run : runs)
    if (is(run))
      chosen.push_back(&run);
  std::stable_sort(chosen.begin(), chosen.end(), [](const auto* a, const auto* b) {
    return largestUnnamedError(*a) > largestUnnamedError(*b);
  });
  std::string text;
  for (std::size_t i = 0; i < std::min(chosen.size(), kMostListedRuns); ++i)
    text += describe(*chosen[i]);
  if (chosen.empty())
    return "";
  if (chosen.size() > kMostListedRuns)
    text += "- and " + std::to_string(chosen.size() - kMostListedRuns) +
            " more, see table.csv\n";
  return "### " + title + "\n" + text + '\n';
}

std::string
boundsMarkdown(const TrustTable& table)
{
  std::string text = "### Stated bounds\n";
  if (table.bounds.empty())
    text += "No map called good states any.\n";
  else
    text +=
        "| bound of 95 % [m] | scans | within it | within 99.9 % | median of error / "
        "bound |\n|---|---|---|---|---|\n";
  for (const BoundCounts& row : table.bounds) {
    const auto percent = [&](std::size_t count) {
      return fixedText(
                 100 * static_cast<double>(count) / static_cast<double>(row.scans), 1) +
             " %";
    };
    const std::string size =
        std::isfinite(row.up_to)
            ? fixedText(row.above, 2) + " to " + fixedText(row.up_to, 2)
            : "above " + fixedText(row.above, 2);
    text += '|' + cell(size) + cell(row.scans) + cell(percent(row.within)) +
            cell(percent(row.within_999)) + cell(fixedText(row.median_ratio, 2)) + '\n';
  }
  if (table.squared_errors.scans > 0)
    text += "\nMean of e' C^-1 e / 3 of positions: " +
            fixedText(table.squared_errors.mean, 2) + " over " +
            std::to_string(table.squared_errors.scans) +
            " scans of maps that are not wrong.\n";
  return text + '\n';
}

TrustJson
jsonOf(const TrustShare& share)
{
  return {{"count", share.count},
          {"of", share.of},
          {"rate", share.rate()},
          {"upper_bound_95", share.upperBound()}};
}

TrustJson
jsonOf(const TrustCounts& row)
{
  return {{"data", row.data},
          {"damage", row.damage},
          {"method", row.method},
          {"runs", row.runs},
          {"failed", row.failed},
          {"without_truth", row.without_truth},
          {"good", row.good},
          {"unverified", row.unverified},
          {"doubted", row.doubted},
          {"wrong", row.wrong},
          {"right", row.right},
          {"false_goods", jsonOf(row.false_goods)},
          {"missed", jsonOf(row.missed)},
          {"false_unverified", jsonOf(row.false_unverified)},
          {"false_verifications", jsonOf(row.false_verifications)},
          {"false_doubts", jsonOf(row.false_doubts)},
          {"false_doubts_by_matching", row.by_matching}};
}

TrustJson
jsonOf(const BoundCounts& row)
{
  return {{"above_m", row.above},
          {"up_to_m", row.up_to}, // infinite: null
          {"scans", row.scans},
          {"within_95", row.within},
          {"within_99_9", row.within_999},
          {"median_ratio", row.median_ratio}};
}

template <typename T>
TrustJson
jsonOfOptional(const std::optional<T>& value)
{
  return value ? TrustJson(*value) : TrustJson();
}

TrustJson
jsonOf(const TrustRun& run)
{
  TrustJson scans = TrustJson::array();
  for (const TrustScan& scan : run.scans)
    scans.push_back({{"file", scan.name},
                     {"error_m", scan.error},
                     {"bound_m", jsonOfOptional(scan.bound)},
                     {"allowed_m", allowedError(scan)},
                     {"named", scan.named},
                     {"squared_error", jsonOfOptional(scan.squared_error)}});
  return {{"data", run.data},
          {"damage", run.damage},
          {"method", run.method},
          {"run", run.name},
          {"call", toString(run.call)},
          {"doubted_by_matching", run.doubted_by_matching},
          {"wrong", isWrong(run)},
          {"right", isRight(run)},
          {"largest_unnamed_error_m", largestUnnamedError(run)},
          {"message", run.message},
          {"scans", scans}};
}

template <typename Row>
TrustJson
jsonOfAll(const std::vector<Row>& rows)
{
  TrustJson list = TrustJson::array();
  for (const Row& row : rows)
    list.push_back(jsonOf(row));
  return list;
}
} // namespace

std::string
trustMarkdown(const std::vector<TrustRun>& runs)
{
  const TrustTable table = trustTable(runs);
  std::string text = countsMarkdown(
      {table.all}, {}, [](const TrustCounts&) { return std::vector<std::string>{}; });
  text += listOf("False goods", runs, [](const TrustRun& run) {
    return run.call == TrustCall::kGood && isWrong(run);
  });
  text += listOf("Wrong and unverified", runs, [](const TrustRun& run) {
    return run.call == TrustCall::kUnverified && isWrong(run);
  });
  text += listOf("Off, but only matching doubts it", runs, [](const TrustRun& run) {
    return run.call == TrustCall::kDoubted && run.doubted_by_matching && !isRight(run);
  });
  text += "### By damage\n" +
          countsMarkdown(table.by_damage, {"damage"}, [](const TrustCounts& row) {
            return std::vector<std::string>{row.damage};
          });
  text += "### By data\n" +
          countsMarkdown(table.by_data, {"data"}, [](const TrustCounts& row) {
            return std::vector<std::string>{row.data};
          });
  if (table.by_method.size() > 1)
    text += "### By method\n" +
            countsMarkdown(table.by_method, {"method"}, [](const TrustCounts& row) {
              return std::vector<std::string>{row.method};
            });
  text += boundsMarkdown(table);
  text += "### All\n" +
          countsMarkdown(
              table.cells, {"data", "damage", "method"}, [](const TrustCounts& row) {
                return std::vector<std::string>{row.data, row.damage, row.method};
              });
  return text + listOf("False doubts", runs, [](const TrustRun& run) {
           return run.call == TrustCall::kDoubted && isRight(run);
         });
}

std::string
trustCsv(const std::vector<TrustRun>& runs)
{
  std::string text =
      "data,damage,method,run,call,doubted_by_matching,wrong,right,scans,"
      "named,largest_unnamed_error_m,message\n";
  for (const TrustRun& run : runs) {
    std::size_t named = 0;
    for (const TrustScan& scan : run.scans)
      named += scan.named;
    const double largest = largestUnnamedError(run);
    text += csvField(run.data) + ',' + csvField(run.damage) + ',' +
            csvField(run.method) + ',' + csvField(run.name) + ',' + toString(run.call) +
            ',' + std::to_string(run.doubted_by_matching) + ',' +
            std::to_string(isWrong(run)) + ',' + std::to_string(isRight(run)) + ',' +
            std::to_string(run.scans.size()) + ',' + std::to_string(named) + ',' +
            (std::isfinite(largest) ? TrustJson(largest).dump() : "inf") + ',' +
            csvField(run.message) + '\n';
  }
  return text;
}

std::string
trustJson(const std::vector<TrustRun>& runs)
{
  const TrustTable table = trustTable(runs);
  const TrustJson json = {
      {"schema_version", 1},
      {"all", jsonOf(table.all)},
      {"by_damage", jsonOfAll(table.by_damage)},
      {"by_data", jsonOfAll(table.by_data)},
      {"by_method", jsonOfAll(table.by_method)},
      {"cells", jsonOfAll(table.cells)},
      {"bounds", jsonOfAll(table.bounds)},
      {"squared_errors",
       {{"scans", table.squared_errors.scans}, {"mean", table.squared_errors.mean}}},
      {"runs", jsonOfAll(runs)}};
  return json.dump(2, ' ', false, TrustJson::error_handler_t::replace) + '\n';
}

} // namespace pcl6d
