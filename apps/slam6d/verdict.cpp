// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/verdict.h"

#include <pcl6d/io/text.h>

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <vector>

namespace pcl6d::app {

namespace {
/** \return ": a.pcd, b.pcd and 3 more" for the scans in a state */
std::string
filesIn(const std::string& state, const RunResult& summary)
{
  constexpr int kMost = 8;
  std::string text;
  int count = 0;
  for (const auto& scan : summary.scans)
    if (scan.state == state && ++count <= kMost)
      text += (count == 1 ? ": " : ", ") + scan.file;
  return count > kMost ? text + " and " + std::to_string(count - kMost) + " more"
                       : text;
}

/** The worst numbers of the matched scans, so that a bad match shows without --verbose. */
void
describeQuality(const RunResult& summary, std::ostream& text)
{
  using Entry = RunResult::ScanEntry;
  std::vector<const Entry*> matched;
  for (const auto& scan : summary.scans)
    if (scan.state == "matched")
      matched.push_back(&scan);
  if (matched.empty())
    return;
  const auto largest = [&](double Entry::*member, double sign) {
    return *std::max_element(
        matched.begin(), matched.end(), [&](const Entry* a, const Entry* b) {
          return sign * a->*member < sign * b->*member;
        });
  };
  const Entry* overlap = largest(&Entry::overlap, -1);
  const Entry* correction = largest(&Entry::correction, 1);
  const Entry* rms = largest(&Entry::rms, 1);
  text << std::fixed << std::setprecision(2) << "\nleast overlap " << overlap->overlap
       << " (" << overlap->file << "), largest correction " << correction->correction
       << " m (" << correction->file << "), largest rms " << std::setprecision(3)
       << rms->rms << " m (" << rms->file << ")";
}

/** A line on each stage after matching. */
void
describeStages(const RunResult& summary, std::ostream& text)
{
  text << std::fixed << std::setprecision(3);
  for (const auto& stage : summary.graph_stages) {
    if (stage.name == "matching")
      continue;
    text << '\n' << stage.name << (stage.undone ? " not taken: " : ": ");
    if (stage.undone)
      text << stage.reason;
    else
      text << "agreement " << stage.agreement_before << " to " << stage.agreement_after;
    if (stage.rounds > 0)
      text << " (" << stage.rounds << (stage.rounds == 1 ? " round" : " rounds") << ")";
  }
}

} // namespace

std::string
verdictOf(const Slam6DResult& result, const RunResult& summary)
{
  const std::string all = text::counted(result.scans.size(), "scan");
  const std::size_t pending = result.count(ScanState::kPending);
  std::ostringstream text;
  if (pending > 0)
    text << "PARTIAL: interrupted; " << pending << " of " << all
         << " not registered, at predicted poses";
  else if (!summary.complete)
    text << "PARTIAL: interrupted; the poses are complete, but scans, map and picture "
            "are missing";
  else if (result.count(ScanState::kFixed) + result.count(ScanState::kMatched) ==
           result.scans.size())
    text << (result.scans.size() == 1
                 ? "1 scan, nothing to match"
                 : "all " + all + " registered, every match converged");
  else
    text << result.count(ScanState::kMatched) + 1 << " of " << all << " registered";
  if (const auto failed = result.count(ScanState::kPredicted))
    text << "\nNOT TO BE TRUSTED: " << text::counted(failed, "scan")
         << " could not be matched, predicted pose kept"
         << filesIn("predicted", summary);
  if (const auto limit = result.count(ScanState::kUnconverged))
    text
        << "\nNOT TO BE TRUSTED: " << text::counted(limit, "scan")
        << " did not converge (bad initial pose, little overlap, --metascan too small?)"
        << filesIn("unconverged", summary);
  if (!summary.floating.empty())
    text << "\nNOT TO BE TRUSTED: no link joins "
         << text::counted(summary.floating.size(), "scan")
         << " to the first one: " << summary.floating.front()
         << (summary.floating.size() > 1 ? ", ..." : "");
  describeQuality(summary, text);
  describeStages(summary, text);
  return text.str();
}

} // namespace pcl6d::app
