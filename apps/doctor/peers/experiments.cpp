// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/peers/class_input.h"
#include "doctor/peers/experiments.h"
#include "doctor/report/words.h"

#include <pcl6d/common/error.h>
#include <pcl6d/registration/feature_alignment.h>
#include <pcl6d/registration/overlap_search.h>

#include <functional>
#include <limits>

namespace pcl6d::app {

namespace {
using Class = RegistrationClass;

constexpr Class kClasses[] = {Class::kPclIcp,
                              Class::kPclIcpWithNormals,
                              Class::kPclGicp,
                              Class::kPclNdt,
                              Class::kIcp6d,
                              Class::kIcp6dWithNormals,
                              Class::kGicp6d,
                              Class::kNdt6d};

Experiment
asItIs(Class method, const DoctorPair& pair)
{
  Experiment row;
  row.method = method;
  row.setting_words = "as it is";
  row.start = pair.start;
  return row;
}

/** With recommended settings, equal for PCL and our classes. */
Experiment
asSet(Class method, const DoctorPair& pair)
{
  Experiment row = asItIs(method, pair);
  row.settings.reach = pair.of_source.spread;
  if (isNdt(method)) {
    row.settings.resolution = pair.resolution;
    row.settings.at_rest = 0.1 * pair.tolerance();
    row.setting_words = "resolution " + metres(pair.resolution);
  }
  else {
    row.settings.max_distance = pair.max_distance;
    row.setting_words = "max distance " + metres(pair.max_distance);
  }
  return row;
}

Experiment
nearZero(Experiment row)
{
  row.input.local = true;
  row.setting_words += ", near 0";
  return row;
}

std::vector<Experiment>
planned(const DoctorPair& pair)
{
  std::vector<Experiment> rows;
  for (const Class method : kClasses) {
    if (isPcl(method) || !pair.canBeMatched())
      rows.push_back(asItIs(method, pair));
    if (pair.canBeMatched())
      rows.push_back(asSet(method, pair));
  }
  for (const Class method : kClasses) // as advised for coordinates too large for float
    if (pair.canBeMatched() && pair.isFar() && !isPcl(method))
      rows.push_back(nearZero(asSet(method, pair)));
  return rows;
}

/** Runs rows with variants of the input. */
class Runner {
public:
  Runner(const DoctorPair& pair, double time_limit, const Interrupt& interrupt)
  : pair_(pair), time_limit_(time_limit), interrupt_(interrupt), inputs_(pair)
  {}

  ClassOutcome
  run(const Experiment& row, const InputVariant& v, const ClassSettings& settings) const
  {
    InputVariant input = v;
    input.local = v.local || row.input.local;
    ClassOutcome out = runClass(
        row.method, settings, inputs_.make(input, row.start), time_limit_, interrupt_);
    if (out.end == RunEnd::kInterrupted)
      throw Interrupted();
    if (out.is_rigid && !input.local)
      out.pose = pair_.toLocal(out.pose);
    return out;
  }

  /** Repeats a run with each variant that may matter for the clouds. */
  void
  probe(Experiment& row) const
  {
    if (row.outcome.end == RunEnd::kTimeOut || row.input.local)
      return;
    const auto again = [&](bool is_wanted, const InputVariant& v) {
      return is_wanted ? std::make_optional(run(row, v, row.settings)) : std::nullopt;
    };
    row.longer = goOn(row);
    row.local = again(pair_.isFar() && pair_.canBeMatched(), local());
    row.without_nan = again(hasNan(), withoutNan());
    row.extracted = again(pair_.source.indices.has_value(), extracted());
    row.whole = again(pair_.source.indices.has_value(), whole());
    row.own_normals = again(wantsNormals(row.method) && hasNormals(), ownNormals());
  }

  /** A class with pairs, from another start, with a maximum distance suited to the start. */
  Experiment
  fromStart(Class method, const Eigen::Isometry3d& start, const char* words) const
  {
    constexpr double kNoLimit = std::numeric_limits<double>::max();
    Experiment row = asSet(method, pair_);
    row.start = start;
    row.start_words = words;
    row.settings.max_distance = pair_.maxDistanceAt(pair_.fitAt(start, kNoLimit));
    row.setting_words =
        "max distance " + metres(*row.settings.max_distance) + ", from " + words;
    if (pair_.isFar())
      row = nearZero(row);
    row.outcome = run(row, {}, row.settings);
    return row;
  }

private:
  static InputVariant
  local()
  {
    InputVariant v;
    v.local = true;
    return v;
  }
  static InputVariant
  withoutNan()
  {
    InputVariant v;
    v.without_nan = true;
    return v;
  }
  static InputVariant
  extracted()
  {
    InputVariant v;
    v.extracted = true;
    v.without_nan = true; // NaN may hide the effect of indices
    return v;
  }
  static InputVariant
  whole()
  {
    InputVariant v;
    v.without_indices = true;
    v.without_nan = true;
    return v;
  }
  static InputVariant
  ownNormals()
  {
    InputVariant v;
    v.own_normals = true;
    return v;
  }

  bool
  hasNan() const
  {
    return pair_.of_source.not_finite + pair_.of_target.not_finite > 0;
  }
  bool
  hasNormals() const
  {
    return !pair_.source.normals.empty() || !pair_.target.normals.empty();
  }

  /** Repeats with ten times the iterations and a stop at a hundredth of the tolerance,
   * to test whether the run had converged. */
  std::optional<ClassOutcome>
  goOn(const Experiment& row) const
  {
    const ClassOutcome& out = row.outcome;
    const bool may_stop_early = row.method == Class::kPclGicp || isNdt(row.method);
    if (!isPcl(row.method) || !out.hasPose() || !out.converged ||
        !pair_.canBeMatched() || !(out.at_limit || may_stop_early))
      return std::nullopt;
    ClassSettings settings = row.settings;
    settings.iterations = 10 * out.limit;
    settings.at_rest = 0.01 * pair_.tolerance();
    settings.reach = pair_.of_source.spread;
    return run(row, {}, settings);
  }

  const DoctorPair& pair_;
  double time_limit_;
  const Interrupt& interrupt_;
  InputMaker inputs_;
};

/** Coarse alignment in a process of its own. \return empty: no pose found, or timeout */
std::optional<Eigen::Isometry3d>
placement(double time_limit,
          const Interrupt& interrupt,
          const std::function<CoarseEstimate()>& search)
{
  const LimitedRun run = runLimited(time_limit, interrupt, [&] {
    const CoarseEstimate found = search();
    nlohmann::json pose = nlohmann::json::array();
    for (int i = 0; found.status == Status::kOk && i < 16; ++i)
      pose.push_back(found.T_target_source.matrix().data()[i]);
    return pose;
  });
  if (run.end == RunEnd::kInterrupted)
    throw Interrupted();
  if (run.end != RunEnd::kDone || run.result.size() != 16)
    return std::nullopt;
  Eigen::Isometry3d pose;
  for (std::size_t i = 0; i < 16; ++i)
    pose.matrix().data()[i] = run.result[i].get<double>();
  return pose;
}

/** The source moved onto the target by aligning their middles. */
Eigen::Isometry3d
middleOnMiddle(const DoctorPair& pair)
{
  const Eigen::Vector3d source = pair.of_source.middle - pair.source.offset;
  const Eigen::Vector3d target = pair.of_target.middle - pair.target.offset;
  Eigen::Isometry3d pose = pair.start;
  pose.translation() = target - pose.linear() * source;
  return pose;
}

/** Features look from the scanners. */
CoarseEstimate
byFeatures(const DoctorPair& pair)
{
  const Eigen::Vector3d at_source = pair.of_source.scanner.place - pair.source.offset;
  const Eigen::Vector3d at_target = pair.of_target.scanner.place - pair.target.offset;
  const Eigen::Isometry3d T_source_scanner(Eigen::Translation3d{at_source});
  const Eigen::Isometry3d T_target_scanner(Eigen::Translation3d{at_target});
  CoarseEstimate found =
      alignByFeatures(transformed(pair.target_points, T_target_scanner.inverse()),
                      transformed(pair.source_points, T_source_scanner.inverse()));
  found.T_target_source =
      T_target_scanner * found.T_target_source * T_source_scanner.inverse();
  return found;
}
} // namespace

std::vector<Experiment>
runExperiments(const DoctorPair& pair,
               double time_limit,
               ProgressBar& bar,
               const Interrupt& interrupt)
{
  std::vector<Experiment> rows = planned(pair);
  const Runner runner(pair, time_limit, interrupt);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    bar.show({"running", i, rows.size()});
    rows[i].outcome = runner.run(rows[i], {}, rows[i].settings);
    runner.probe(rows[i]);
  }
  bar.show({"running", rows.size(), rows.size()});
  return rows;
}

std::vector<Experiment>
runCoarseStarts(const DoctorPair& pair,
                double time_limit,
                ProgressBar& bar,
                const Interrupt& interrupt)
{
  const Eigen::Isometry3d near = pair.startsApart() ? middleOnMiddle(pair) : pair.start;
  const std::vector<std::pair<const char*, std::function<CoarseEstimate()>>> searches =
      {{"pcl6d::searchByOverlap()",
        [&] { return searchByOverlap(pair.target_points, pair.source_points, near); }},
       {"pcl6d::alignByFeatures()", [&] { return byFeatures(pair); }}};
  const Runner runner(pair, time_limit, interrupt);
  std::vector<Experiment> rows;
  const auto runFrom = [&](const Eigen::Isometry3d& start, const char* words) {
    for (const Class method : {Class::kIcp6dWithNormals, Class::kGicp6d})
      rows.push_back(runner.fromStart(method, start, words));
  };
  if (pair.startsApart())
    runFrom(near, "middle on middle");
  for (std::size_t i = 0; i < searches.size(); ++i) {
    bar.show({"coarse starts", i, searches.size()});
    if (const auto start = placement(time_limit, interrupt, searches[i].second))
      runFrom(*start, searches[i].first);
  }
  bar.show({"coarse starts", searches.size(), searches.size()});
  return rows;
}

} // namespace pcl6d::app
