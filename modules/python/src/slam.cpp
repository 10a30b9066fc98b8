// SPDX-License-Identifier: BSD-3-Clause
#include "arrays.h"
#include "bindings.h"
#include "long_call.h"
#include "options.h"
#include "slam_results.h"

#include <pcl6d/slam6d/slam6d.h>

#include <atomic>
#include <memory>
#include <pybind11/stl.h>
#include <string>
#include <vector>

namespace pcl6d::python {

namespace {
/** Slam6D with the data for results, and a guard: one call at a time. */
struct Slam {
  explicit Slam(const Slam6DOptions& options) : slam(options) {}

  Slam6D slam;
  std::vector<Eigen::Vector3d> offsets; ///< of each scan [m]
  std::vector<std::string> names;       ///< of each scan
  std::atomic<bool> is_busy{false};
};

/** Holds a Slam for the length of a call. */
class Turn {
public:
  explicit Turn(std::shared_ptr<Slam> slam) : slam_(std::move(slam))
  {
    if (slam_->is_busy.exchange(true))
      throw BadArgument("Slam6D is busy with another call: wait for the end, or make a "
                        "Slam6D for each thread");
  }
  ~Turn() { slam_->is_busy = false; }
  Turn(const Turn&) = delete;
  Turn&
  operator=(const Turn&) = delete;

  Slam&
  operator*() const
  {
    return *slam_;
  }
  Slam*
  operator->() const
  {
    return slam_.get();
  }

private:
  std::shared_ptr<Slam> slam_;
};

void
addScan(const std::shared_ptr<Slam>& slam,
        const py::object& points,
        const py::object& initial_pose,
        const py::object& scan_name,
        const py::object& progress)
{
  const auto name = valueOf<std::string>(scan_name, "name", "a word");
  const auto turn = std::make_shared<Turn>(slam);
  const auto cloud = std::make_shared<Cloud>(cloudOf(points, "points", 3));
  const Eigen::Isometry3d pose =
      cloud->poseOfPoints(poseOf(initial_pose, "initial_pose"));
  runLong(progress, [turn, cloud, pose, name](CallWatch& watch) {
    watch.report({"adding", 0, 1});
    (*turn)->slam.addScan(cloud->points, pose, name);
    (*turn)->offsets.push_back(cloud->offset);
    (*turn)->names.push_back(name);
  });
}

bool
optimize(const std::shared_ptr<Slam>& slam, const py::object& progress)
{
  const auto turn = std::make_shared<Turn>(slam);
  const auto work = [turn](CallWatch& watch) {
    Slam6D& slam6d = (*turn)->slam;
    slam6d.setProgressCallback([&](const Progress& report) {
      if (watch.isStopped())
        slam6d.cancel();
      else
        watch.tell(report);
    });
    const bool is_complete = slam6d.optimize();
    slam6d.setProgressCallback({});
    return is_complete;
  };
  return longCall(progress, work, Stopping::kInSteps); // so that it can go on later
}

py::dict
resultOf(const std::shared_ptr<Slam>& slam)
{
  const Turn turn(slam);
  const Slam6DResult& result = turn->slam.result();
  py::dict dict;
  py::list scans;
  for (std::size_t i = 0; i < result.scans.size(); ++i) {
    py::dict scan = scanDict(result.scans[i], turn->offsets.at(i));
    scan["name"] = turn->names.at(i); // the library uses names and indices of files
    scan["index"] = i;
    scans.append(scan);
  }
  dict["scans"] = scans;
  dict["reliable"] = result.trusted();
  dict["verification"] = verificationOrNone(result.verification);
  py::dict parameters;
  for (const auto& option : usedOptions(OptionWords(), result.parameters))
    parameters[option.name.c_str()] = option.value;
  dict["parameters"] = parameters;
  dict["disconnected"] = result.floating;
  return dict;
}
} // namespace

void
bindSlam(py::module_& module)
{
  py::class_<Slam, std::shared_ptr<Slam>>(module, "Slam")
      .def(py::init([](const py::dict& values) {
        return std::make_shared<Slam>(slamOptions(values));
      }))
      .def("add_scan", &addScan)
      .def("optimize", &optimize)
      .def("result", &resultOf);
}

} // namespace pcl6d::python
