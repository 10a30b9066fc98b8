// SPDX-License-Identifier: BSD-3-Clause
#include "arrays.h"
#include "bindings.h"
#include "long_call.h"
#include "options.h"
#include "scans.h"

#include <pcl6d/benchmarking/map_quality.h>
#include <pcl6d/benchmarking/trajectory_error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/io/trajectory_io.h>

#include <memory>
#include <pybind11/stl.h>

namespace pcl6d::python {

namespace {
Trajectory
trajectoryOf(const py::object& poses, const py::object& stamps, const std::string& name)
{
  Trajectory trajectory;
  trajectory.poses = posesOf(poses, name);
  if (!stamps.is_none())
    trajectory.stamps = valueOf<std::vector<double>>(
        stamps, name + ".stamps", "a number [s] for each pose");
  return trajectory;
}

py::tuple
readPoses(const py::object& path)
{
  const std::filesystem::path file = pathOf(path, "path");
  const Trajectory trajectory =
      longCall(py::none(), [file](CallWatch&) { return readTrajectory(file); });
  return py::make_tuple(arrayOf(trajectory.poses),
                        trajectory.stamps.empty() ? py::object(py::none())
                                                  : arrayOf(trajectory.stamps));
}

py::dict
errorsDict(const ErrorStatistics& errors)
{
  py::dict dict;
  dict["count"] = errors.count;
  dict["rmse"] = errors.rms;
  dict["mean"] = errors.mean;
  dict["median"] = errors.median;
  dict["max"] = errors.max;
  return dict;
}

py::dict
evaluatePoses(const py::object& estimate,
              const py::object& estimate_stamps,
              const py::object& reference,
              const py::object& reference_stamps,
              const py::dict& values,
              const py::object& progress)
{
  TrajectoryEvaluationOptions evaluation;
  Options options(values);
  options.number("max_time_difference", evaluation.matching.max_time_difference);
  options.number("interpolation_gap", evaluation.interpolation_gap);
  options.take<std::vector<double>>("lengths", "lengths [m]", evaluation.lengths);
  options.requireKnown();
  const Trajectory first = trajectoryOf(estimate, estimate_stamps, "estimate");
  const Trajectory second = trajectoryOf(reference, reference_stamps, "reference");
  const TrajectoryEvaluation found =
      longCall(progress, [first, second, evaluation](CallWatch& watch) {
        watch.report({"evaluating", 0, 1});
        return evaluateTrajectory(first, second, evaluation);
      });
  py::dict dict;
  dict["num_pairs"] = found.matching.pairs.size();
  dict["matched_by_time"] = found.matching.by_time;
  dict["path_length"] = found.path_length;
  dict["alignment"] = arrayOf(found.alignment.transform);
  dict["status"] = toString(found.alignment.status);
  dict["position"] = errorsDict(found.with_alignment.position);
  dict["orientation"] = errorsDict(found.with_alignment.orientation);
  dict["position_without_alignment"] = errorsDict(found.without_alignment.position);
  dict["orientation_without_alignment"] =
      errorsDict(found.without_alignment.orientation);
  dict["step_translation"] = errorsDict(found.steps.translation);
  dict["step_rotation"] = errorsDict(found.steps.rotation);
  dict["translation_per_metre"] = found.drift.translation_per_metre;
  dict["rotation_per_metre"] = found.drift.rotation_per_metre;
  dict["loop_translation"] = errorsDict(found.loops.translation);
  return dict;
}

/** The scans of a map, near the origin of the map. */
struct MapInput {
  std::vector<Points> scans;
  std::vector<Eigen::Isometry3d> poses;
  Points reference;
  MapQualityOptions options;
};

MapInput
mapInput(const py::sequence& scans,
         const py::object& poses,
         const py::object& reference)
{
  MapInput input;
  input.poses = posesOf(poses, "poses");
  if (input.poses.size() != py::len(scans))
    throw BadArgument("poses has " + std::to_string(input.poses.size()) +
                      " poses, but must have a pose for each of " +
                      std::to_string(py::len(scans)) + " scans");
  for (std::size_t i = 0; i < input.poses.size(); ++i) {
    Cloud cloud = cloudOf(scans[i], "scans[" + std::to_string(i) + "]", 3);
    input.poses[i] = cloud.poseOfPoints(input.poses[i]);
    input.scans.push_back(std::move(cloud.points));
  }
  const Eigen::Vector3d offset = input.poses.empty()
                                     ? Eigen::Vector3d(Eigen::Vector3d::Zero())
                                     : worldOffset(input.poses.front());
  for (auto& pose : input.poses)
    pose.pretranslate(-offset);
  if (!reference.is_none())
    input.reference = cloudAbout(reference, "reference", offset).points;
  return input;
}

py::dict
qualityDict(const ScanQuality& scan)
{
  py::dict dict;
  dict["num_neighbours"] = scan.neighbours;
  dict["agreement"] = scan.agreement;
  dict["entropy"] = scan.entropy;
  dict["thickness"] = scan.thickness;
  dict["distance_to_others"] = scan.others.plane.rms;
  dict["distance_to_reference"] = scan.reference.plane.rms;
  dict["stands_out"] = scan.stands_out;
  return dict;
}

py::dict
evaluatePoints(const py::sequence& scans,
               const py::object& poses,
               const py::object& reference,
               const py::dict& values,
               const py::object& progress)
{
  const auto input = std::make_shared<MapInput>(mapInput(scans, poses, reference));
  Options options(values);
  options.number("voxel", input->options.voxel);
  options.number("radius", input->options.radius);
  options.number("max_distance", input->options.max_distance);
  options.take<bool>("planes", "True or False", input->options.planes);
  options.count("num_threads", input->options.num_threads);
  options.requireKnown();
  const MapQuality quality = longCall(progress, [input](CallWatch& watch) {
    watch.report({"evaluating", 0, 1});
    input->options.progress = watch.callback();
    return measureMap(input->scans, input->poses, input->options, input->reference);
  });
  py::dict dict;
  dict["num_pairs"] = quality.pairs;
  dict["agreement"] = quality.agreement;
  dict["entropy"] = quality.entropy;
  dict["plane_variance"] = quality.plane_variance;
  dict["thickness"] = quality.thickness.rms;
  dict["distance_to_others"] = quality.others.plane.rms;
  dict["distance_to_reference"] = quality.reference.plane.rms;
  dict["revisit_blur"] = quality.revisit_blur;
  py::list rows;
  for (const ScanQuality& scan : quality.scans)
    rows.append(qualityDict(scan));
  dict["scans"] = rows;
  dict["worst_first"] = quality.worstFirst();
  return dict;
}
} // namespace

void
bindEvaluation(py::module_& module)
{
  module.def("read_trajectory", &readPoses);
  module.def("evaluate_trajectory", &evaluatePoses);
  module.def("evaluate_map", &evaluatePoints);
}

} // namespace pcl6d::python
