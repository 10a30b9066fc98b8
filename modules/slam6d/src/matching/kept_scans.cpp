// SPDX-License-Identifier: BSD-3-Clause
#include "matching/kept_scans.h"

#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/slam6d/auto_parameters.h>
#include <pcl6d/slam6d/scan_preparation.h>

#include <optional>
#include <utility>

namespace pcl6d {

// Serialisation for the other processes.

template <typename Archive>
void
packFields(Archive& archive, Parameter& parameter)
{
  archive(parameter.value, parameter.given, parameter.why);
}

template <typename Archive>
void
packFields(Archive& archive, Slam6DParameters& p)
{
  archive(p.median_range);
  for (Parameter* parameter : parametersOf(p))
    archive(*parameter);
}
} // namespace pcl6d

namespace pcl6d::slam6d {

namespace {
/** Number of scans kept in full until the parameters are derived from them. */
constexpr std::size_t kScansForParameters = 16;

/** Scans that each process prepares at a time when processes share the work. */
constexpr std::size_t kPreparedAtATime = 4;
} // namespace

/** A scan, prepared by the process that owns the scan. */
struct PreparedScan {
  std::optional<IcpModel> model; ///< of an own scan
  Points gated;                  ///< of an own scan
  Points points;                 ///< reduced; of another process's scan
  Normals normals;               ///< of points; empty for metrics without normals
};

void
packFields(Packer& packer, PreparedScan& scan)
{
  packer(scan.model->points(), scan.model->normals());
}

void
packFields(Unpacker& unpacker, PreparedScan& scan)
{
  unpacker(scan.points, scan.normals);
}

void
KeptScans::add(const Points& points, const std::string& name, const DriveContext& drive)
{
  const bool is_own = !sharing_ || sharing_->owns(names_.size());
  unreduced_.push_back({points, is_own ? drive.submap : std::vector<PosedPoints>()});
  names_.push_back(name);
  are_steps_measured_.push_back(drive.is_step_measured);
  frames_.push_back(drive.frame);
}

void
KeptScans::forget(std::size_t place)
{
  names_.resize(place);
  are_steps_measured_.resize(place);
  frames_.resize(place);
  if (reduced_.size() + unreduced_.size() > place)
    unreduced_.pop_back();
}

bool
KeptScans::isFull(bool has_parameters) const
{
  if (!has_parameters)
    return unreduced_.size() >= kScansForParameters;
  return unreduced_.size() >= (sharing_ ? kPreparedAtATime * sharing_->numRanks() : 1);
}

Slam6DParameters
KeptScans::derive(const Slam6DOptions& options) const
{
  Slam6DParameters parameters;
  if (isFirst()) {
    std::vector<Points> scans;
    for (const Waiting& scan : unreduced_)
      scans.push_back(scan.points);
    parameters = deriveParameters(options, scans);
  }
  return sharing_ ? sharing_->fromFirst(parameters) : parameters;
}

void
KeptScans::keep(IcpModel reduced, Points gated, std::vector<ScanResult>& scans)
{
  scans[reduced_.size()].reduced = reduced.points().size();
  reduced_.push_back(std::move(reduced));
  measured_.emplace_back(std::move(gated));
  unreduced_.pop_front();
}

void
KeptScans::prepare(const ScanMatcher& matcher,
                   const Slam6DParameters& parameters,
                   const ProgressCallback& report,
                   std::vector<ScanResult>& scans)
{
  if (sharing_)
    return prepareShared(matcher, parameters, scans);
  while (!unreduced_.empty()) {
    const std::string& name = names_[reduced_.size()];
    Points gated = gateScan(unreduced_.front().points, name, parameters);
    IcpModel model = matcher.prepare(reduce(gated, 0, parameters));
    keep(std::move(model), std::move(gated), scans);
    if (report)
      report({"reducing", reduced_.size(), names_.size()});
  }
}

void
KeptScans::prepareShared(const ScanMatcher& matcher,
                         const Slam6DParameters& parameters,
                         std::vector<ScanResult>& scans)
{
  const std::size_t done = reduced_.size();
  std::vector<PreparedScan> prepared(unreduced_.size());
  const auto place = [&](std::size_t k) { return done + k; };
  sharedFor(sharing_, options_.num_threads, prepared, place, [&](std::size_t k) {
    const std::string& name = names_[done + k];
    prepared[k].gated = gateScan(unreduced_[k].points, name, parameters);
    prepared[k].model = matcher.prepare(reduce(prepared[k].gated, k, parameters));
  });
  for (PreparedScan& scan : prepared) {
    if (!scan.model && scan.normals.empty())
      scan.model = matcher.prepare(std::move(scan.points)); // a metric without normals
    else if (!scan.model)
      scan.model.emplace(
          std::move(scan.points), std::move(scan.normals), matcher.modelOptions(true));
    if (isFirst() && scan.gated.empty()) // the first process matches all scans
      scan.gated =
          gateScan(unreduced_.front().points, names_[reduced_.size()], parameters);
    keep(*std::move(scan.model), std::move(scan.gated), scans);
  }
}

Points
KeptScans::reduce(const Points& gated,
                  std::size_t k,
                  const Slam6DParameters& parameters) const
{
  ReductionOptions reduction;
  reduction.method = options_.reduction;
  reduction.points_per_voxel = options_.reduction_points;
  reduction.seed = options_.seed;
  const std::string& name = names_[reduced_.size() + k];
  const std::vector<PosedPoints>& submap = unreduced_[k].submap;
  if (submap.empty() || parameters.planar_rows.value > 0)
    return reduceScan(gated, name, parameters, reduction);
  Points all = gated;
  for (const PosedPoints& sweep : submap) {
    const Points moved = transformed(gateByRange(sweep.points,
                                                 parameters.min_range.value,
                                                 parameters.max_range.value),
                                     sweep.pose);
    all.insert(all.end(), moved.begin(), moved.end());
  }
  return reduceScan(all, name, parameters, reduction);
}

} // namespace pcl6d::slam6d
