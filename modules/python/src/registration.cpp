// SPDX-License-Identifier: BSD-3-Clause
#include "bindings.h"
#include "long_call.h"
#include "options.h"
#include "pose_results.h"

#include <pcl6d/global_registration/pair_placer.h>
#include <pcl6d/registration/icp.h>
#include <pcl6d/registration/icp_model.h>
#include <pcl6d/registration/ndt.h>

#include <memory>

namespace pcl6d::python {

namespace {
constexpr std::size_t kLeastPoints = 3; ///< minimum for a rigid motion

/** Both scans and where to start. */
struct Pair {
  Cloud target, source;
  Eigen::Isometry3d guess = Eigen::Isometry3d::Identity(); ///< of the centred points

  Pair(const py::object& target_rows,
       const py::object& source_rows,
       const py::object& pose)
  : target(cloudOf(target_rows, "target", kLeastPoints))
  , source(cloudOf(source_rows, "source", kLeastPoints))
  {
    guess = pose.is_none() ? guessOfPair(Eigen::Isometry3d::Identity(), target, source)
                           : guessOfPair(poseOf(pose, "guess"), target, source);
  }
};

struct IcpSettings {
  IcpOptions icp;
  IcpModel::Options model;
};

IcpSettings
icpSettings(const py::dict& values)
{
  IcpSettings settings;
  Options options(values);
  options.word("metric", settings.icp.metric, metricFromName);
  options.word("robust", settings.icp.robust, robustKernelFromName);
  options.word("search", settings.model.search, searchMethodFromName);
  options.number("max_distance", settings.icp.max_distance);
  options.number("max_distance_start", settings.icp.max_distance_start);
  options.number("distance_decay", settings.icp.distance_decay);
  options.number("kept_share", settings.icp.kept_share);
  options.number("translation_epsilon", settings.icp.translation_epsilon);
  options.number("rotation_epsilon", settings.icp.rotation_epsilon);
  options.number("gicp_epsilon", settings.icp.gicp_epsilon);
  options.take<int>("max_iterations", "a whole number", settings.icp.max_iterations);
  options.count("neighbours", settings.model.neighbours);
  options.count("num_threads", settings.icp.num_threads);
  options.requireKnown();
  settings.icp.validate();
  settings.model.num_threads = settings.icp.num_threads;
  return settings;
}

/** The common part of the results of icp(), ndt() and register(). */
py::dict
poseDict(const Pair& pair, const Eigen::Isometry3d& T_target_source, const char* status)
{
  py::dict dict;
  dict["T_target_source"] =
      arrayOf(poseOfPair(T_target_source, pair.target, pair.source));
  dict["status"] = status;
  dict["inlier_rmse"] = py::none();
  dict["covariance"] = py::none();
  dict["free_directions"] = arrayOf(Eigen::MatrixXd(0, 6));
  dict["iterations"] = 0;
  dict["reason"] = "";
  return dict;
}

IcpResult
runIcp(Pair& pair, IcpSettings settings, CallWatch& watch)
{
  const bool plane = settings.icp.metric == Metric::kPlane;
  const bool gicp = settings.icp.metric == Metric::kGicp;
  settings.model.normals = plane || gicp;
  watch.report({"preparing", 0, 2});
  const IcpModel target(std::move(pair.target.points), settings.model);
  watch.report({"preparing", 1, 2});
  settings.model.normals = gicp;
  const Points source_points = std::move(pair.source.points);
  Normals normals;
  if (gicp)
    normals = estimateNormals(source_points,
                              PointTree(source_points, settings.icp.num_threads),
                              settings.model.neighbours,
                              settings.icp.num_threads);
  watch.report({"preparing", 2, 2});
  IcpHooks hooks;
  const auto total = static_cast<std::size_t>(settings.icp.max_iterations);
  hooks.observer = [&](const IcpIteration& iteration) {
    watch.report({"matching", static_cast<std::size_t>(iteration.number), total});
    return true;
  };
  IcpSource source;
  source.points = &source_points;
  source.normals = gicp ? &normals : nullptr;
  return icp({target.part()}, source, pair.guess, settings.icp, hooks);
}

py::dict
icpDict(const py::object& target,
        const py::object& source,
        const py::object& guess,
        const py::dict& values,
        const py::object& progress)
{
  const IcpSettings settings = icpSettings(values);
  const auto pair = std::make_shared<Pair>(target, source, guess);
  const IcpResult result = longCall(progress, [pair, settings](CallWatch& watch) {
    return runIcp(*pair, settings, watch);
  });
  py::dict dict = poseDict(*pair, result.T_target_source, toString(result.status));
  dict["converged"] = result.status == Status::kOk;
  dict["num_inliers"] = result.pairs;
  dict["fitness"] = result.overlap;
  if (result.pairs > 0)
    dict["inlier_rmse"] = result.rms;
  dict["iterations"] = result.iterations;
  dict["reason"] = toString(result.stop);
  if (result.covariance)
    dict["covariance"] = matrixOrNone(movedCovariance(
        *result.covariance, result.T_target_source, pair->source.offset));
  if (result.localizability)
    dict["free_directions"] = freeDirections(*result.localizability);
  return dict;
}

struct NdtSettings {
  NdtOptions ndt;
  double resolution = 1; ///< [m] default of NDT6D
  std::size_t least_points = 6;
};

NdtSettings
ndtSettings(const py::dict& values)
{
  NdtSettings settings;
  Options options(values);
  options.number("resolution", settings.resolution);
  options.number("step_size", settings.ndt.step_size);
  options.number("outlier_ratio", settings.ndt.outlier_ratio);
  options.number("translation_epsilon", settings.ndt.translation_epsilon);
  options.number("rotation_epsilon", settings.ndt.rotation_epsilon);
  options.take<int>("max_iterations", "a whole number", settings.ndt.max_iterations);
  options.count("min_points", settings.least_points);
  options.count("num_threads", settings.ndt.num_threads);
  options.requireKnown();
  settings.ndt.validate();
  return settings;
}

py::dict
ndtDict(const py::object& target,
        const py::object& source,
        const py::object& guess,
        const py::dict& values,
        const py::object& progress)
{
  const NdtSettings settings = ndtSettings(values);
  const auto pair = std::make_shared<Pair>(target, source, guess);
  const NdtResult result = longCall(progress, [pair, settings](CallWatch& watch) {
    watch.report({"preparing", 0, 1});
    const DistributionGrid grid(
        pair->target.points, settings.resolution, settings.least_points);
    watch.report({"preparing", 1, 1});
    return ndt(grid, pair->source.points, pair->guess, settings.ndt);
  });
  py::dict dict = poseDict(*pair, result.T_target_source, toString(result.status));
  dict["converged"] = result.status == Status::kOk;
  dict["num_inliers"] = result.points;
  dict["fitness"] =
      static_cast<double>(result.points) / static_cast<double>(pair->source.num_finite);
  dict["iterations"] = result.iterations;
  dict["reason"] = toString(result.stop);
  dict["free_directions"] = freeDirections(result.localizability);
  return dict;
}

PairPlacerOptions
placerOptions(const py::dict& values)
{
  PairPlacerOptions placer;
  Options options(values);
  options.number("voxel", placer.parameters.voxel);
  options.number("min_range", placer.parameters.min_range);
  options.number("max_range", placer.parameters.max_range);
  options.number("max_ambiguity", placer.search.max_ambiguity);
  options.number("min_overlap", placer.search.min_overlap);
  options.take<bool>("any_axis", "True or False", placer.search.any_axis);
  options.count("num_threads", placer.search.num_threads);
  options.requireKnown();
  placer.validate();
  return placer;
}

py::dict
placeDict(const py::object& target,
          const py::object& source,
          const py::dict& values,
          const py::object& progress)
{
  const PairPlacerOptions options = placerOptions(values);
  const auto pair = std::make_shared<Pair>(target, source, py::none());
  const PairPlacement found = longCall(progress, [pair, options](CallWatch& watch) {
    watch.report({"registering", 0, 1});
    PairPlacer placer;
    placer.setOptions(options);
    PairPlacement placement = placer.place(pair->target.points, pair->source.points);
    watch.report({"registering", 1, 1});
    return placement;
  });
  py::dict dict = poseDict(*pair, found.T_target_source, toString(found.result.answer));
  dict["converged"] = found.result.answer == PlaceAnswer::kUnique;
  dict["reason"] = toWords(found.result.rejection);
  dict["num_inliers"] = 0;
  dict["fitness"] = 0.0;
  if (found.result.candidates.empty())
    return dict;
  const PlaceCandidate& best = found.result.candidates.front();
  dict["num_inliers"] = best.evidence.fit.pairs;
  dict["fitness"] = best.overlap;
  dict["inlier_rmse"] = best.evidence.fit.residual;
  dict["free_directions"] = freeDirections(best.evidence.fit);
  const Matrix6d covariance =
      eulerCovariance(linkCheck(0, 1, best.evidence, best.test_result).covariance,
                      found.T_target_source);
  dict["covariance"] = matrixOrNone(
      movedCovariance(covariance, found.T_target_source, pair->source.offset));
  return dict;
}
} // namespace

void
bindRegistration(py::module_& module)
{
  module.def("icp", &icpDict);
  module.def("ndt", &ndtDict);
  module.def("register", &placeDict);
}

} // namespace pcl6d::python
