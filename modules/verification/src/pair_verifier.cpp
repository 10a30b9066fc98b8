// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/verification/pair_verifier.h>

#include <utility>

namespace pcl6d {

namespace {
/** Points in the frame of the scanner, with the scanner at the origin. */
Points
fromOrigin(const PairVerifier::Cloud& cloud)
{
  Points points = cloud.points;
  for (auto& p : points)
    p -= cloud.origin;
  return points;
}

void
requireCloud(const std::optional<PairVerifier::Cloud>& cloud, const char* name)
{
  require(cloud.has_value(), name, "null", "set");
  require(
      cloud->origin.allFinite(), "sensor origin", cloud->origin.transpose(), "finite");
}
} // namespace

PairVerdict
verifyLink(const PreparedScans& scans,
           std::size_t first,
           std::size_t second,
           const Eigen::Isometry3d& T_first_second)
{
  PairVerdict verdict;
  verdict.evidence =
      linkEvidence(scans.scans()[first], scans.scans()[second], T_first_second);
  verdict.background = contradictionBackground({verdict.evidence});
  verdict.test_result = testLink(verdict.evidence, verdict.background);
  if (verdict.test_result.trust == LinkTrust::kGood &&
      scans.firstLike(first) == scans.firstLike(second)) {
    verdict.test_result.trust = LinkTrust::kUnverified;
    verdict.test_result.rejection = RejectReason::kSamePoints;
  }
  return verdict;
}

void
PairVerifier::setSource(Cloud cloud)
{
  source_ = std::move(cloud);
  prepared_.reset();
}

void
PairVerifier::setTarget(Cloud cloud)
{
  target_ = std::move(cloud);
  prepared_.reset();
}

void
PairVerifier::setParameters(const ScanParameterOptions& options)
{
  options.validate();
  options_ = options;
  prepared_.reset();
}

void
PairVerifier::prepare()
{
  if (prepared_)
    return;
  requireCloud(target_, "input target");
  requireCloud(source_, "input source");
  const std::vector<Points> clouds = {fromOrigin(*target_), fromOrigin(*source_)};
  PreparedScans prepared(2, deriveScanParameters(options_, clouds));
  prepared.set(0, clouds[0], "input target");
  prepared.set(1, clouds[1], "input source");
  prepared_ = std::move(prepared);
}

const ScanParameters&
PairVerifier::parameters()
{
  prepare();
  return prepared_->parameters();
}

PairVerdict
PairVerifier::verify(const Eigen::Isometry3d& T_target_source)
{
  const bool is_affine =
      T_target_source.matrix().row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1), 1e-6);
  require(is_affine && isRigid(T_target_source), "pose", "no rigid motion", "one");
  prepare();
  Eigen::Isometry3d T = T_target_source;
  T.linear() = nearestRotation(T.linear());
  T = Eigen::Translation3d(-target_->origin.cast<double>()) * T *
      Eigen::Translation3d(source_->origin.cast<double>());
  return verifyLink(*prepared_, 0, 1, T);
}

} // namespace pcl6d
