// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/suite/suite_report.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/run/run_summary.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <limits>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;
using Poses = std::vector<Eigen::Isometry3d>;

TrustCall
callOf(const RunRecord& record, const RunResult& run)
{
  if (!record.hasResult())
    return TrustCall::kNone;
  if (record.end.exit_code != 0)
    return TrustCall::kDoubted;
  return run.verification && run.verification->trust == MapTrust::kGood
             ? TrustCall::kGood
             : TrustCall::kUnverified;
}

bool
isNamed(const RunResult& run, std::size_t i)
{
  const ScanResult& scan = run.scans[i];
  if (scan.state != ScanState::kFixed && scan.state != ScanState::kMatched)
    return true;
  if (std::find(run.floating.begin(), run.floating.end(), scan.file) !=
      run.floating.end())
    return true;
  if (!run.verification)
    return false;
  const ScanCheck& check = run.verification->scans.at(i);
  const bool is_doubted =
      check.doubt && check.doubt.reason != RejectReason::kSecondPoseNotSought;
  return is_doubted || (run.scans.size() > 1 && !check.tied);
}

/** \return the lines of a verdict that doubt the map, joined */
std::string
doubtsIn(const std::string& verdict)
{
  std::string text;
  for (std::size_t begin = 0; begin < verdict.size();) {
    const std::size_t end = std::min(verdict.find('\n', begin), verdict.size());
    const std::string line = verdict.substr(begin, end - begin);
    if (line.rfind("NOT TO BE TRUSTED: ", 0) == 0)
      text += (text.empty() ? "" : "; ") + line.substr(line.find(' ', 14) + 1);
    begin = end + 1;
  }
  return text;
}

/** Compares one map with the truth. */
class MapEvaluation {
public:
  /** \param[in] truth of every scan in the folder
   * \param[in] foreign index of the scan without a true pose in the map */
  MapEvaluation(const RunResult& run,
                const Poses& truth,
                std::optional<std::size_t> foreign)
  : run_(run), truth_(truth), foreign_(foreign)
  {}

  /** \return empty if no scan has a true pose */
  std::vector<TrustScan>
  evaluate() const
  {
    const auto origin = findOrigin();
    if (!origin)
      return {};
    const Eigen::Isometry3d T_map_truth =
        run_.scans[*origin].T_world_scan * trueScan(*origin).inverse();
    std::vector<TrustScan> scans;
    for (std::size_t i = 0; i < run_.scans.size(); ++i)
      scans.push_back(evaluateScan(i, T_map_truth, *origin));
    return scans;
  }

private:
  bool
  hasTruth(std::size_t i) const
  {
    const auto index = static_cast<std::size_t>(run_.scans[i].index);
    return index < truth_.size() && foreign_ != index;
  }

  const Eigen::Isometry3d&
  trueScan(std::size_t i) const
  {
    return truth_[static_cast<std::size_t>(run_.scans[i].index)];
  }

  /** \return the first scan with a true pose that is not named; if every scan is named,
   * the first with a true pose */
  std::optional<std::size_t>
  findOrigin() const
  {
    std::optional<std::size_t> first;
    for (std::size_t i = 0; i < run_.scans.size(); ++i) {
      if (!hasTruth(i))
        continue;
      if (!isNamed(run_, i))
        return i;
      if (!first)
        first = i;
    }
    return first;
  }

  TrustScan
  evaluateScan(std::size_t i,
               const Eigen::Isometry3d& T_map_truth,
               std::size_t origin) const
  {
    const ScanResult& scan = run_.scans[i];
    TrustScan evaluated;
    evaluated.name = scan.file;
    evaluated.named = isNamed(run_, i);
    if (run_.verification)
      evaluated.bound = run_.verification->scans.at(i).bound;
    evaluated.error = std::numeric_limits<double>::infinity();
    if (!hasTruth(i))
      return evaluated;
    const Eigen::Vector3d error =
        scan.T_world_scan.translation() - (T_map_truth * trueScan(i)).translation();
    evaluated.error = error.norm();
    if (scan.covariance && origin == 0) // covariances are relative to the first scan
      evaluated.squared_error =
          squaredError(error, scan.covariance->topLeftCorner<3, 3>());
    return evaluated;
  }

  /** \return empty for a singular covariance, such as the first scan's */
  static std::optional<double>
  squaredError(const Eigen::Vector3d& error, const Eigen::Matrix3d& covariance)
  {
    const Eigen::LLT<Eigen::Matrix3d> cholesky(covariance);
    if (cholesky.info() != Eigen::Success || !(cholesky.rcond() > 1e-12))
      return std::nullopt;
    return error.dot(cholesky.solve(error));
  }

  const RunResult& run_;
  const Poses& truth_;
  const std::optional<std::size_t> foreign_;
};

TrustRun
evaluateRun(const Suite& suite, const SuiteFolder& folder, const SuiteRun& run)
{
  const SuiteData& data = suite.data[run.data];
  const SuiteMethod& method = suite.methods[run.method];
  const fs::path place = folder.runOf(data, method, run.repetition);
  TrustRun evaluated;
  evaluated.data = data.entry;
  evaluated.damage = data.damage.name;
  evaluated.method = method.name;
  evaluated.name = place.lexically_relative(folder.folder).string();
  evaluated.message = run.no_data;
  if (!run.record)
    return evaluated;
  evaluated.message = run.record->hasResult() ? "" : run.record->verdict();
  if (!run.record->message.empty())
    evaluated.message += ": " + run.record->message;
  if (!run.record->hasResult())
    return evaluated;
  const RunResult summary = readRunSummary(place / "result" / "summary.json");
  evaluated.call = callOf(*run.record, summary);
  evaluated.doubted_by_matching = evaluated.call == TrustCall::kDoubted &&
                                  summary.verification &&
                                  summary.verification->trusted();
  evaluated.message = doubtsIn(summary.verdict);
  const fs::path truth = folder.truthOf(data);
  if (!truth.empty() && fs::exists(truth))
    evaluated.scans =
        MapEvaluation(summary, readTrajectory(truth).poses, data.damage.foreign)
            .evaluate();
  return evaluated;
}
} // namespace

std::vector<TrustRun>
evaluateSuite(const Suite& suite,
              const SuiteFolder& folder,
              const std::vector<SuiteRun>& runs)
{
  std::vector<TrustRun> evaluated;
  for (const SuiteRun& run : runs) {
    try {
      evaluated.push_back(evaluateRun(suite, folder, run));
    } catch (const pcl::PCLException& error) {
      TrustRun broken;
      broken.data = suite.data[run.data].entry;
      broken.damage = suite.data[run.data].damage.name;
      broken.method = suite.methods[run.method].name;
      broken.message = error.what();
      evaluated.push_back(broken);
    }
  }
  return evaluated;
}

} // namespace pcl6d::app
