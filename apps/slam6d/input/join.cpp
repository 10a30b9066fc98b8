// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "slam6d/input/join.h"
#include "slam6d/input/join_checks.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/option_names.h>
#include <pcl6d/io/scan_name.h>
#include <pcl6d/io/text.h>
#include <pcl6d/run/registered_scans.h>
#include <pcl6d/slam6d/groups_apart.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <set>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

std::size_t
countOf(std::size_t run, const EarlierRuns& runs)
{
  return static_cast<std::size_t>(
      std::count_if(runs.scans.begin(), runs.scans.end(), [&](const auto& scan) {
        return scan.run == run;
      }));
}

/** \return the name of a run's folder, with its parent folder if another run has an equal name */
std::string
shortNameOf(std::size_t run, const EarlierRuns& runs)
{
  const auto nameOf = [&](std::size_t r) {
    const fs::path path = fs::absolute(runs.runs[r].path()).lexically_normal();
    return path.has_filename() ? path : path.parent_path(); // for "run/"
  };
  const fs::path path = nameOf(run);
  for (std::size_t r = 0; r < runs.runs.size(); ++r)
    if (r != run && nameOf(r).filename() == path.filename())
      return path.parent_path().filename().string() + '_' + path.filename().string();
  return path.filename().string();
}

/** \return unused names for a run's scans \param[in,out] taken gets the names */
std::vector<std::string>
freeNames(const std::vector<std::string>& names,
          const std::string& run,
          std::set<std::string>& taken)
{
  std::string prefix;
  for (int k = 1;; ++k) {
    std::vector<std::string> free;
    free.reserve(names.size());
    for (const auto& name : names)
      free.push_back(prefix + name);
    if (std::none_of(free.begin(), free.end(), [&](const std::string& name) {
          return taken.count(name) > 0;
        })) {
      taken.insert(free.begin(), free.end());
      return free;
    }
    prefix = run + (k > 1 ? std::to_string(k) : "") + '_';
  }
}

/** \return stamps of all scans; empty unless all runs have increasing stamps */
std::vector<double>
stampsOfAll(const EarlierRuns& runs)
{
  std::vector<std::vector<double>> of_runs;
  for (const RunFolder& run : runs.runs)
    of_runs.push_back(stampsOfRun(run.path(), run.summary()));
  std::vector<double> stamps;
  for (const auto& scan : runs.scans) {
    if (of_runs[scan.run].empty())
      return {};
    const double stamp = of_runs[scan.run][scan.place];
    if (!stamps.empty() && stamp <= stamps.back())
      return {};
    stamps.push_back(stamp);
  }
  return stamps;
}

bool
areAlike(const std::optional<MovedPoints>& a, const std::optional<MovedPoints>& b)
{
  return a.has_value() == b.has_value() &&
         (!a || (a->reading == b->reading && a->offset == b->offset));
}

double
lengthOf(std::size_t run, const std::string& name, const EarlierRuns& runs)
{
  const RunFolder& folder = runs.runs[run];
  return lengthOfRun(folder.summary(), name, folder.path() / "summary.json");
}

/** \return the largest or smallest value of a length used by the runs */
double
extremeOf(const std::string& name, bool largest, const EarlierRuns& runs)
{
  double extreme = lengthOf(0, name, runs);
  for (std::size_t r = 1; r < runs.runs.size(); ++r) {
    const double value = lengthOf(r, name, runs);
    extreme = largest ? std::max(extreme, value) : std::min(extreme, value);
  }
  return extreme;
}
} // namespace

ScanResult
EarlierRuns::resultOf(std::size_t i) const
{
  const RunResult& run = runs[scans[i].run].summary();
  ScanResult scan = run.scans.at(scans[i].place);
  if (areJoined() && isFloating(scan, run))
    scan.state = ScanState::kPredicted;
  if (scan.recovered == RecoveredBy::kBeside) {
    scan.state = ScanState::kPredicted;
    scan.recovered = RecoveredBy::kNone;
    scan.rejections = {RejectReason::kNoConsistentLink};
  }
  return scan;
}

EarlierRuns
openJoined(const Settings& settings)
{
  requireOnce(settings.joined);
  EarlierRuns runs;
  for (const std::string& path : settings.joined) {
    requireOutside(settings.out, path);
    runs.runs.push_back(RunFolder::finished(
        path, "the run was interrupted; start the run again, then join"));
    runs.runs.back().requireWhole("scans/");
  }
  requireSameUnits(runs.runs);
  takeScans(runs);
  for (std::size_t r = 1; r < runs.runs.size(); ++r)
    if (!areAlike(runs.runs[r].summary().moved, runs.runs[0].summary().moved)) {
      runs.notes.push_back("the runs subtracted different offsets from far points: "
                           "poses belong to the points in scans/, near the origin");
      break;
    }
  return runs;
}

ScanFolder
joinedFolder(const EarlierRuns& runs)
{
  std::vector<ScanFolder::Registered> scans;
  std::set<std::string> taken;
  int next = 0;
  for (std::size_t r = 0; r < runs.runs.size(); ++r) {
    const RunFolder& run = runs.runs[r];
    std::vector<std::string> names;
    const std::size_t begin = scans.size();
    for (const auto& one : runs.scans) {
      if (one.run != r)
        continue;
      const ScanResult& scan = run.summary().scans[one.place];
      run.requireScan(one.place);
      const fs::path file = run.path() / "scans" / (scanName(scan.index) + ".pcd");
      names.push_back(scan.file);
      scans.push_back({file, "", r == 0 ? scan.index : next, scan.initial_pose});
      next = std::max(next, scans.back().index + 1);
    }
    names = freeNames(names, shortNameOf(r, runs), taken);
    for (std::size_t k = 0; k < names.size(); ++k)
      scans[begin + k].name = names[k];
  }
  auto moved = runs.runs[0].summary().moved;
  std::string source = "the runs";
  for (const RunFolder& run : runs.runs) {
    source += (&run == &runs.runs.front() ? " " : ", ") + run.path().string();
    if (!areAlike(run.summary().moved, moved))
      moved.reset();
  }
  return ScanFolder::ofRuns(scans, stampsOfAll(runs), moved, source);
}

std::vector<std::pair<double, double>>
gatesOf(const EarlierRuns& runs, const Settings& settings)
{
  // Where the grid ends, at 2^18 voxels, is no gate of a scanner.
  constexpr double kOpen = 1e5; // voxels
  const auto gateOf = [&](std::size_t run) {
    const double most = lengthOf(run, kMaxRangeOption, runs);
    const bool is_open =
        settings.slam.max_range || most > kOpen * lengthOf(run, kVoxelOption, runs);
    return std::make_pair(
        settings.slam.min_range ? 0.0 : lengthOf(run, kMinRangeOption, runs),
        is_open ? std::numeric_limits<double>::infinity() : most);
  };
  std::vector<std::pair<double, double>> gates;
  bool differ = false;
  for (const auto& scan : runs.scans) {
    gates.push_back(gateOf(scan.run));
    differ = differ || gates.back() != gates.front();
  }
  return differ ? gates : std::vector<std::pair<double, double>>();
}

void
takeLengths(const EarlierRuns& runs, Settings& settings)
{
  const auto take = [&](const std::string& name,
                        bool largest,
                        const std::string& what,
                        std::optional<double>& length) {
    if (length)
      return;
    length = extremeOf(name, largest, runs);
    settings.length_reasons[name] = "the " + what + " of the runs";
  };
  take(kVoxelOption, true, "coarsest", settings.slam.voxel);
  take(kMinRangeOption, false, "smallest", settings.slam.min_range);
  take(kMaxRangeOption, true, "largest", settings.slam.max_range);
}

std::string
joinedWords(const EarlierRuns& runs)
{
  const auto nameOf = [&](std::size_t r) {
    return runs.runs[r].path().string() + " (" +
           text::counted(countOf(r, runs), "scan") + ")";
  };
  std::string words = "joined ";
  for (std::size_t r = 1; r < runs.runs.size(); ++r)
    words += (r == 1 ? "" : r + 1 == runs.runs.size() ? " and " : ", ") + nameOf(r);
  return words + " to " + nameOf(0);
}

bool
optimize(Slam6D& slam, const EarlierRuns& runs)
{
  try {
    return slam.optimize();
  } catch (const GroupsApart& apart) {
    throw ComputeFailed(runs.runs.at(apart.group()).path().string() +
                        ": does not meet " + runs.runs[0].path().string() + ": " +
                        apart.reason() + "; nothing is written");
  }
}

} // namespace pcl6d::app
