// SPDX-License-Identifier: BSD-3-Clause
#include "common/unit_guess.h"
#include "evaluate/changes/changes_source.h"
#include "evaluate/placed_scans.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/median.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/io/text.h>
#include <pcl6d/run/registered_scans.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <sstream>
#include <utility>

namespace pcl6d::app {

namespace {
RunFolder
openCompared(const std::string& path)
{
  namespace fs = std::filesystem;
  if (fs::is_directory(path) && !fs::exists(fs::path(path) / "summary.json"))
    throw IoFailed(path + ": is a folder, but no run of pcl_slam6d (no summary.json)");
  return RunFolder::finished(path, "the run was interrupted; start the run again");
}

double
lengthOf(const RunFolder& run, const char* name)
{
  return lengthOfRun(run.summary(), name, run.path() / "summary.json");
}

/** \return the points within the range gate \throws ComputeFailed fewer than 3 points */
Points
gated(const Points& measured, double least, double most, const std::string& name)
{
  Points points = gateByRange(measured, least, most);
  if (points.size() >= 3)
    return points;
  std::ostringstream message;
  message << name << ": " << points.size() << " points within the range gate of "
          << least << " to " << most << " m, but at least 3 are needed";
  throw ComputeFailed(message.str());
}

/** \return [m] the median range over some scans of a run */
double
typicalRange(const std::vector<Points>& scans)
{
  constexpr std::size_t kMeasured = 4; // evenly among all
  std::vector<double> ranges;
  const std::size_t count = std::min(kMeasured, scans.size());
  for (std::size_t k = 0; k < count; ++k)
    ranges.push_back(medianRange(scans[k * scans.size() / count]));
  return upperMedian(ranges);
}

Parameter
coarserVoxel(const std::vector<RunFolder>& runs, const std::optional<double>& given)
{
  const double coarser =
      std::max(lengthOf(runs[0], "voxel"), lengthOf(runs[1], "voxel"));
  return orDerived(given, {coarser, false, "the coarser of the runs"});
}
} // namespace

ComparedRuns::ComparedRuns(const ChangesSettings& s, const ProgressCallback& show)
{
  for (const std::string& path : {s.run_a, s.run_b}) {
    runs_.push_back(openCompared(path));
    const RunResult& run = runs_.back().summary();
    places_.push_back(placedScans(run));
    if (places_.back().empty())
      throw IoFailed(path + ": holds no scan with a reliable pose");
    if (places_.back().size() < run.scans.size())
      notes_.push_back(path + ": " +
                       text::counted(run.scans.size() - places_.back().size(), "scan") +
                       " without a reliable pose in the run left out");
    if (!run.trusted)
      notes_.push_back(path + ": doubtful by the verdict of the run");
  }
  std::vector<Points> points = read(s, 0, show), of_b = read(s, 1, show);
  const std::string guess =
      unitGuess(s.run_b, typicalRange(of_b), s.run_a, typicalRange(points));
  if (!guess.empty())
    throw IoFailed(guess);
  points.insert(points.end(),
                std::make_move_iterator(of_b.begin()),
                std::make_move_iterator(of_b.end()));
  ScanParameters parameters;
  parameters.voxel = coarserVoxel(runs_, s.parameters.voxel);
  parameters.min_range.value = 0; // each has been gated by itself
  parameters.max_range.value = std::numeric_limits<double>::infinity();
  prepared_.emplace(points.size(), parameters, 1);
  parallelFor(points.size(), s.num_threads, [&](std::size_t i) {
    const bool of_a = i < size(0);
    prepared_->set(
        i, std::exchange(points[i], {}), of_a ? name(0, i) : name(1, i - size(0)));
  });
}

std::string
ComparedRuns::name(std::size_t run, std::size_t i) const
{
  return runs_[run].path().string() + ": " +
         runs_[run].summary().scans[places_[run][i]].file;
}

std::vector<Points>
ComparedRuns::read(const ChangesSettings& s,
                   std::size_t run,
                   const ProgressCallback& show) const
{
  const RunFolder& folder = runs_[run];
  const double least = s.parameters.min_range.value_or(lengthOf(folder, "min-range"));
  const double most = s.parameters.max_range.value_or(lengthOf(folder, "max-range"));
  std::vector<Points> points(size(run));
  // small enough to show progress and to be interrupted
  constexpr std::size_t kBatch = 8;
  for (std::size_t begin = 0; begin < points.size(); begin += kBatch) {
    const std::size_t end = std::min(begin + kBatch, points.size());
    parallelFor(end - begin, s.num_threads, [&](std::size_t k) {
      const std::size_t i = begin + k;
      points[i] = gated(folder.readScan(places_[run][i]), least, most, name(run, i));
    });
    show({"reading", end, points.size()});
  }
  return points;
}

ComparedRun
ComparedRuns::compared(std::size_t run) const
{
  ComparedRun scans;
  for (std::size_t i = 0; i < size(run); ++i) {
    const VerifiedScan& one = scan(run, i);
    ComparedScan compared;
    compared.points = &one.surfaces().points();
    compared.normals = &one.surfaces().normals();
    compared.rays = &one.rays();
    compared.T_world_scan = Eigen::Translation3d(-worldOffset()) *
                            runs_[run].summary().scans[places_[run][i]].T_world_scan;
    scans.push_back(compared);
  }
  return scans;
}

std::vector<std::pair<std::size_t, std::size_t>>
ComparedRuns::copies() const
{
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < size(1); ++i) {
    const std::size_t first = prepared_->firstLike(size(0) + i);
    if (first < size(0))
      pairs.emplace_back(first, i);
  }
  return pairs;
}

} // namespace pcl6d::app
