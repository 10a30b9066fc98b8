// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/peers/experiments.h"

#include <pcl6d/verification/pcl/registration_verifier.h>

#include <pcl/memory.h>
#include <pcl/point_cloud.h>

#include <cmath>

namespace pcl6d::app {

namespace {
using Json = nlohmann::json;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/** The whole scan near 0, whatever the indices. */
Cloud::Ptr
localCloud(const DoctorCloud& cloud)
{
  auto made = pcl::make_shared<Cloud>();
  for (const auto& p : cloud.localPoints(cloud.finiteRows(false)))
    made->emplace_back(p.x(), p.y(), p.z());
  return made;
}

/** Tests the poses in one call, as the scans are prepared once. */
Json
verdictsOf(const DoctorPair& pair, const std::vector<Experiment>& rows)
{
  RegistrationVerifier<pcl::PointXYZ> verifier;
  verifier.setInputSource(localCloud(pair.source));
  verifier.setInputTarget(localCloud(pair.target));
  const auto local = [](const CloudMeasures& of, const DoctorCloud& cloud) {
    return Eigen::Vector3f((of.scanner.place - cloud.offset).cast<float>());
  };
  verifier.setSourceOrigin(local(pair.of_source, pair.source));
  verifier.setTargetOrigin(local(pair.of_target, pair.target));
  Json verdicts = Json::array();
  for (const Experiment& row : rows) {
    if (!row.outcome.hasPose()) {
      verdicts.push_back(nullptr);
      continue;
    }
    const PairVerdict verdict = verifier.verify(row.outcome.pose.matrix());
    verdicts.push_back({{"trust", toString(verdict.test_result.trust)},
                        {"probability", verdict.test_result.probability_wrong},
                        {"patches", verdict.evidence.sight.patches},
                        {"contradicted", verdict.evidence.sight.contradicted_patches},
                        {"reason", toWords(verdict.test_result.rejection)}});
  }
  return verdicts;
}

void
take(const Json& json, PoseVerdict& verdict)
{
  json.at("trust").get_to(verdict.trust);
  json.at("probability").get_to(verdict.probability_wrong);
  json.at("patches").get_to(verdict.patches);
  json.at("contradicted").get_to(verdict.contradicted);
  json.at("reason").get_to(verdict.reason);
}

std::string
reasonOf(const LimitedRun& run)
{
  if (run.end == RunEnd::kTimeOut)
    return "the time limit of the verification was over";
  return "the verification failed: " + run.words;
}

/** Weak and unverified poses are undecided by rays: the fit decides. */
int
rankOf(const PoseVerdict& verdict)
{
  return verdict.isGood() ? 2 : verdict.trust == "wrong" ? 0 : 1;
}
} // namespace

void
evaluate(const DoctorPair& pair,
         double time_limit,
         std::vector<Experiment>& rows,
         const Interrupt& interrupt)
{
  for (Experiment& row : rows) {
    if (row.outcome.hasPose())
      row.verdict.fit = pair.fitAt(row.outcome.pose, pair.max_distance);
    row.verdict.reason = row.outcome.hasPose() ? "" : "no pose";
  }
  if (!pair.canBeMatched())
    return;
  const LimitedRun run =
      runLimited(time_limit, interrupt, [&] { return verdictsOf(pair, rows); });
  if (run.end == RunEnd::kInterrupted)
    throw Interrupted();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].outcome.hasPose())
      continue;
    if (run.end == RunEnd::kDone)
      take(run.result.at(i), rows[i].verdict);
    else
      rows[i].verdict.reason = reasonOf(run);
  }
}

std::optional<std::size_t>
bestOf(const DoctorPair& pair, const std::vector<Experiment>& rows, bool only_ours)
{
  std::optional<std::size_t> best;
  if (!pair.canBeMatched())
    return best;
  // Misfits that differ by less than the tolerance count as equal: then ours goes first.
  const auto better = [&](const Experiment& a, const Experiment& b) {
    const int by_rank = rankOf(a.verdict) - rankOf(b.verdict);
    const double by_misfit = b.verdict.fit.misfit - a.verdict.fit.misfit;
    if (by_rank != 0)
      return by_rank > 0;
    if (isPcl(a.method) != isPcl(b.method) && std::abs(by_misfit) < pair.tolerance())
      return isPcl(b.method);
    return by_misfit > 0;
  };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].outcome.hasPose() || (only_ours && isPcl(rows[i].method)))
      continue;
    if (!best || better(rows[i], rows[*best]))
      best = i;
  }
  return best;
}

} // namespace pcl6d::app
