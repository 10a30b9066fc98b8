// SPDX-License-Identifier: BSD-3-Clause
#include "arrays.h"
#include "bindings.h"
#include "long_call.h"
#include "scans.h"
#include "slam_results.h"

#include <pcl6d/run/run_folder.h>
#include <pcl6d/run/run_links_io.h>

#include <memory>
#include <pybind11/stl.h>

namespace pcl6d::python {

namespace {
using Run = std::shared_ptr<RunFolder>;

Run
openRun(const py::object& path)
{
  const std::filesystem::path folder = pathOf(path, "path");
  return longCall(py::none(),
                  [folder](CallWatch&) { return std::make_shared<RunFolder>(folder); });
}

py::dict
summaryOf(const Run& run)
{
  const RunResult& summary = run->summary();
  py::dict dict;
  py::list scans;
  for (const ScanResult& scan : summary.scans)
    scans.append(scanDict(scan));
  dict["scans"] = scans;
  dict["complete"] = summary.complete;
  dict["reliable"] = summary.trusted;
  dict["verdict"] = summary.verdict;
  dict["warnings"] = summary.warnings;
  dict["pose_source"] = summary.pose_source;
  dict["world_offset"] = arrayOf(Eigen::MatrixXd(summary.world_offset)).reshape({3});
  py::dict options;
  for (const RunResult::Option& option : summary.options)
    options[option.name.c_str()] = option.value;
  dict["options"] = options;
  dict["missing"] = run->missing();
  return dict;
}

/** \return the verification of the summary, with the links of verification.csv if there is one */
py::object
verificationOf(const Run& run)
{
  std::optional<MapVerification> map = run->summary().verification;
  if (map && run->has("verification.csv"))
    map->links = longCall(py::none(), [run](CallWatch&) {
      return readLinkChecks(run->path() / "verification.csv");
    });
  return verificationOrNone(map);
}

py::dict
mapOf(const Run& run, const py::object& progress)
{
  const RunMap map = longCall(progress, [run](CallWatch& watch) {
    watch.report({"reading", 0, 1});
    return run->readMap();
  });
  py::dict dict;
  dict["points"] = arrayOf(map.points);
  dict["scan"] = map.scans.empty() ? py::object(py::none()) : arrayOf(map.scans);
  dict["intensity"] =
      map.intensities.empty() ? py::object(py::none()) : arrayOf(map.intensities);
  return dict;
}

py::array
scanPoints(const Run& run, std::size_t i, const py::object& progress)
{
  if (i >= run->summary().scans.size())
    throw py::index_error("scan " + std::to_string(i) + " of " +
                          std::to_string(run->summary().scans.size()));
  return arrayOf(longCall(progress, [run, i](CallWatch& watch) {
    watch.report({"reading", 0, 1});
    return run->readScan(i);
  }));
}

py::list
linksOf(const Run& run)
{
  const auto links =
      longCall(py::none(), [run](CallWatch&) { return run->readLinks(); });
  py::list list;
  for (const RunLink& link : links) {
    py::dict dict;
    dict["first"] = link.from;
    dict["second"] = link.to;
    dict["kind"] = toString(link.kind);
    dict["verdict"] = toString(link.verdict);
    dict["reason"] = toWords(link.rejection);
    dict["num_inliers"] = link.pairs;
    dict["inlier_rmse"] = link.rms;
    dict["fitness"] = link.overlap;
    list.append(dict);
  }
  return list;
}
} // namespace

void
bindRuns(py::module_& module)
{
  py::class_<RunFolder, Run>(module, "RunFolder")
      .def(py::init(&openRun))
      .def("summary", &summaryOf)
      .def("verification", &verificationOf)
      .def("map", &mapOf)
      .def("scan", &scanPoints)
      .def("links", &linksOf);
}

} // namespace pcl6d::python
