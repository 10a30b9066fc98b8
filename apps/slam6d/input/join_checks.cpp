// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/unit_guess.h"
#include "slam6d/input/join_checks.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/fingerprint.h>
#include <pcl6d/common/median.h>
#include <pcl6d/common/option_names.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/io/text.h>
#include <pcl6d/run/registered_scans.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

/** Number of evenly chosen scans of a run from which the range of its scans is estimated. */
constexpr std::size_t kMeasured = 4;

/** \return [m] median range of the points within the run's range gate */
double
typicalRange(const RunFolder& run)
{
  const fs::path file = run.path() / "summary.json";
  const double least = lengthOfRun(run.summary(), kMinRangeOption, file);
  const double most = lengthOfRun(run.summary(), kMaxRangeOption, file);
  const std::size_t count = run.summary().scans.size();
  const std::size_t measured = std::min(count, kMeasured);
  std::vector<double> ranges;
  for (std::size_t k = 0; k < measured; ++k)
    ranges.push_back(
        medianRange(gateByRange(run.readScan(k * count / measured), least, most)));
  return upperMedian(ranges);
}

/** \brief Scans identified by their content. Only scans with equal numbers of points are read. */
class SeenScans {
public:
  explicit SeenScans(const std::vector<RunFolder>& runs) : runs_(runs) {}

  /** \return whether an earlier run has a scan with identical points */
  bool
  isKnown(const EarlierRuns::Taken& scan)
  {
    const auto [begin, end] = seen_.equal_range(scanOf(scan).points);
    for (auto other = begin; other != end; ++other)
      if (other->second.run != scan.run &&
          fingerprintOf(other->second) == fingerprintOf(scan))
        return true;
    return false;
  }
  void
  add(const EarlierRuns::Taken& scan)
  {
    seen_.emplace(scanOf(scan).points, scan);
  }

private:
  const ScanResult&
  scanOf(const EarlierRuns::Taken& scan) const
  {
    return runs_[scan.run].summary().scans[scan.place];
  }
  std::uint64_t
  fingerprintOf(const EarlierRuns::Taken& scan)
  {
    const auto known = fingerprints_.find({scan.run, scan.place});
    if (known != fingerprints_.end())
      return known->second;
    Fingerprint sum;
    sum.add(runs_[scan.run].readScan(scan.place));
    return fingerprints_[{scan.run, scan.place}] = sum.value();
  }

  const std::vector<RunFolder>& runs_;
  std::multimap<std::size_t, EarlierRuns::Taken> seen_; ///< by their number of points
  std::map<std::pair<std::size_t, std::size_t>, std::uint64_t> fingerprints_;
};

/** Adds the messages about a run. */
void
noteOf(const RunFolder& run, std::size_t copies, std::vector<std::string>& notes)
{
  const RunResult& summary = run.summary();
  const std::string name = run.path().string() + ": ";
  if (copies > 0)
    notes.push_back(name + text::counted(copies, "scan") +
                    " with the very same points as a run before: used once");
  const auto unsure = std::count_if(
      summary.scans.begin(), summary.scans.end(), [&](const ScanResult& scan) {
        return scan.state == ScanState::kPredicted || isFloating(scan, summary);
      });
  if (unsure > 0)
    notes.push_back(name + text::counted(static_cast<std::size_t>(unsure), "scan") +
                    " disconnected from the run: searched anew in the joined map");
  else if (!summary.trusted)
    notes.push_back(name + "doubtful by the verdict of the run");
}
} // namespace

void
requireOnce(const std::vector<std::string>& folders)
{
  if (folders.size() < 2)
    throw UsageError("--join needs two finished runs: --join RUN_A RUN_B -o OUT_DIR");
  std::error_code error;
  for (std::size_t b = 1; b < folders.size(); ++b)
    for (std::size_t a = 0; a < b; ++a)
      if (fs::equivalent(folders[a], folders[b], error))
        throw UsageError("--join " + folders[a] + ' ' + folders[b] +
                         ": both arguments are one folder");
}

void
requireOutside(const fs::path& out, const fs::path& run)
{
  std::error_code error; // missing files are ignored: they contain no folder
  fs::path above = fs::weakly_canonical(fs::absolute(out), error).parent_path();
  for (; above.has_relative_path(); above = above.parent_path())
    if (fs::equivalent(above, run, error))
      throw IoFailed(out.string() + ": lies inside " + run.string() +
                     ", an input of --join; write outside of this folder");
}

void
requireSameUnits(const std::vector<RunFolder>& runs)
{
  std::vector<double> ranges;
  for (const RunFolder& run : runs)
    ranges.push_back(typicalRange(run));
  for (std::size_t r = 1; r < runs.size(); ++r) {
    const std::string guess = unitGuess(
        runs[r].path().string(), ranges[r], runs[0].path().string(), ranges[0]);
    if (!guess.empty())
      throw IoFailed(guess + "; nothing is written");
  }
}

bool
isFloating(const ScanResult& scan, const RunResult& run)
{
  return std::find(run.floating.begin(), run.floating.end(), scan.file) !=
         run.floating.end();
}

void
takeScans(EarlierRuns& runs)
{
  SeenScans seen(runs.runs);
  for (std::size_t r = 0; r < runs.runs.size(); ++r) {
    const std::size_t before = runs.scans.size();
    const std::size_t count = runs.runs[r].summary().scans.size();
    for (std::size_t place = 0; place < count; ++place)
      if (!seen.isKnown({r, place}))
        runs.scans.push_back({r, place});
    if (runs.scans.size() == before)
      text::fail(runs.runs[r].path(),
                 "its " + text::counted(count, "scan") + (count > 1 ? " are" : " is") +
                     " in " +
                     (r == 1 ? runs.runs[0].path().string() : "the runs before") +
                     " already, with identical points: nothing to join");
    noteOf(runs.runs[r], before + count - runs.scans.size(), runs.notes);
    for (std::size_t k = before; k < runs.scans.size(); ++k)
      seen.add(runs.scans[k]);
  }
}

} // namespace pcl6d::app
