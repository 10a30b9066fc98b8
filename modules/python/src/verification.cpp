// SPDX-License-Identifier: BSD-3-Clause
#include "bindings.h"
#include "long_call.h"
#include "options.h"
#include "pose_results.h"

#include <pcl6d/verification/pair_verifier.h>

#include <memory>
#include <utility>

namespace pcl6d::python {

namespace {
/** The scans of a pair with the positions of the scanners. */
struct VerifiedPair {
  Cloud target, source;
  Eigen::Isometry3d T_target_source; ///< of the centred points
  PairVerifier verifier;
};

PairVerifier::Cloud
scanFrom(Cloud& cloud, const Eigen::Vector3d& origin)
{
  return {std::move(cloud.points), (origin - cloud.offset).cast<float>()};
}

ScanParameterOptions
parametersOf(const py::dict& values, Eigen::Vector3d& target, Eigen::Vector3d& source)
{
  ScanParameterOptions parameters;
  Options options(values);
  options.number("voxel", parameters.voxel);
  options.number("min_range", parameters.min_range);
  options.number("max_range", parameters.max_range);
  py::object target_origin = py::make_tuple(0.0, 0.0, 0.0);
  py::object source_origin = target_origin;
  options.take<py::object>("target_origin", "a position", target_origin);
  options.take<py::object>("source_origin", "a position", source_origin);
  options.requireKnown();
  parameters.validate();
  target = positionOf(target_origin, "target_origin");
  source = positionOf(source_origin, "source_origin");
  return parameters;
}

py::dict
testDict(const VerifiedPair& pair, const PairVerdict& verdict)
{
  const LinkEvidence& evidence = verdict.evidence;
  py::dict dict;
  dict["result"] = toString(verdict.test_result.trust);
  dict["probability_wrong"] = verdict.test_result.probability_wrong;
  dict["reason"] = toWords(verdict.test_result.rejection);
  dict["num_patches"] = evidence.sight.patches;
  dict["num_violated"] = evidence.sight.contradicted_patches;
  dict["num_inliers"] = evidence.fit.pairs;
  dict["fitness"] = evidence.fit.overlap;
  dict["inlier_rmse"] = evidence.fit.residual;
  dict["shift"] = evidence.leaving();
  dict["deviation"] = evidence.deviation();
  dict["free_directions"] = freeDirections(evidence.fit);
  dict["covariance"] = py::none();
  if (evidence.fit.pairs > 0) {
    const Matrix6d covariance =
        eulerCovariance(linkCheck(0, 1, evidence, verdict.test_result).covariance,
                        pair.T_target_source);
    dict["covariance"] = matrixOrNone(
        movedCovariance(covariance, pair.T_target_source, pair.source.offset));
  }
  return dict;
}

py::dict
verifyDict(const py::object& target,
           const py::object& source,
           const py::object& pose,
           const py::dict& values,
           const py::object& progress)
{
  Eigen::Vector3d target_origin, source_origin;
  const ScanParameterOptions parameters =
      parametersOf(values, target_origin, source_origin);
  const auto pair = std::make_shared<VerifiedPair>();
  pair->target = cloudOf(target, "target", 3);
  pair->source = cloudOf(source, "source", 3);
  if (pose.is_none())
    throw BadArgument("T_target_source is None, but must be the pose to verify");
  pair->T_target_source =
      guessOfPair(poseOf(pose, "T_target_source"), pair->target, pair->source);
  pair->verifier.setParameters(parameters);
  pair->verifier.setTarget(scanFrom(pair->target, target_origin));
  pair->verifier.setSource(scanFrom(pair->source, source_origin));
  const PairVerdict verdict = longCall(progress, [pair](CallWatch& watch) {
    watch.report({"verifying", 0, 1});
    PairVerdict result = pair->verifier.verify(pair->T_target_source);
    watch.report({"verifying", 1, 1});
    return result;
  });
  return testDict(*pair, verdict);
}
} // namespace

void
bindVerification(py::module_& module)
{
  module.def("verify", &verifyDict);
}

} // namespace pcl6d::python
