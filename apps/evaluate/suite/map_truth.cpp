// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/suite/map_truth.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <limits>

namespace pcl6d::app {

namespace {
using Poses = std::vector<Eigen::Isometry3d>;

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

/** \return e' C^-1 e; empty for a singular covariance, such as the first scan's */
std::optional<double>
squaredError(const Eigen::Vector3d& error, const Eigen::Matrix3d& covariance)
{
  const Eigen::LLT<Eigen::Matrix3d> cholesky(covariance);
  if (cholesky.info() != Eigen::Success || !(cholesky.rcond() > 1e-12))
    return std::nullopt;
  return error.dot(cholesky.solve(error));
}

/** Compares one map with the truth. */
class MapEvaluation {
public:
  MapEvaluation(const RunResult& run,
                const std::vector<bool>& named,
                const Poses& truth,
                std::optional<std::size_t> foreign)
  : run_(run), named_(named), truth_(truth), foreign_(foreign)
  {}

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
      if (!named_[i])
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
    evaluated.named = named_[i];
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

  const RunResult& run_;
  const std::vector<bool>& named_;
  const Poses& truth_;
  const std::optional<std::size_t> foreign_;
};
} // namespace

std::vector<bool>
namedScans(const RunResult& run)
{
  std::vector<bool> named;
  for (std::size_t i = 0; i < run.scans.size(); ++i)
    named.push_back(isNamed(run, i));
  return named;
}

std::vector<TrustScan>
compareWithTruth(const RunResult& run,
                 const std::vector<bool>& named,
                 const std::vector<Eigen::Isometry3d>& truth,
                 std::optional<std::size_t> foreign)
{
  return MapEvaluation(run, named, truth, foreign).evaluate();
}

} // namespace pcl6d::app
