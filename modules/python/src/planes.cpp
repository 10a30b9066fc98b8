// SPDX-License-Identifier: BSD-3-Clause
#include "arrays.h"
#include "bindings.h"
#include "long_call.h"
#include "options.h"

#include <pcl6d/plane_segmentation/segment_planes.h>

#include <memory>

namespace pcl6d::python {

namespace {
struct PlaneSearch {
  Cloud cloud;
  PlaneCloudOptions surface;
  PlaneMethod method = PlaneMethod::kRegionGrowing;
  PlaneSegmentationOptions segmentation;
};

py::dict
planeDict(Plane plane, const std::vector<std::uint32_t>& points, const Cloud& cloud)
{
  plane.offset += plane.normal.dot(cloud.offset);
  Eigen::MatrixXd hull(plane.hull.size(), 3);
  for (Eigen::Index i = 0; i < hull.rows(); ++i) {
    plane.hull[static_cast<std::size_t>(i)] += cloud.offset;
    hull.row(i) = plane.hull[static_cast<std::size_t>(i)].transpose();
  }
  py::dict dict;
  dict["normal"] = arrayOf(Eigen::MatrixXd(plane.normal)).reshape({3});
  dict["offset"] = plane.offset;
  dict["hull"] = arrayOf(hull);
  dict["area"] = plane.area;
  dict["num_inliers"] = points.size();
  dict["inlier_rmse"] = plane.rms;
  dict["indices"] = arrayOf(std::vector<std::int64_t>(points.begin(), points.end()));
  return dict;
}

py::list
findPlanes(const py::object& points, const py::dict& values, const py::object& progress)
{
  const auto search = std::make_shared<PlaneSearch>();
  py::object viewpoint = py::make_tuple(0.0, 0.0, 0.0);
  std::string method = "region-growing";
  Options options(values);
  options.take<std::string>("method", "a word", method);
  options.take<py::object>("viewpoint", "a position", viewpoint);
  options.number("voxel", search->surface.voxel);
  options.number("noise", search->surface.noise);
  options.number("min_area", search->segmentation.planes.min_area);
  options.count("num_threads", search->surface.num_threads);
  options.requireKnown();
  search->method = choosePlaneMethod(method, search->segmentation);
  search->segmentation.validate();
  search->cloud = cloudOf(points, "points");
  search->surface.viewpoint =
      (positionOf(viewpoint, "viewpoint") - search->cloud.offset).cast<float>();
  search->surface.validate(search->cloud.points.size());
  const PlaneSegments found = longCall(progress, [search](CallWatch& watch) {
    watch.report({"surfaces", 0, 1});
    const PlaneCloud cloud(search->cloud.points, search->surface);
    watch.report({"surfaces", 1, 1});
    PlaneSegments segments = segmentPlanes(cloud, search->method, search->segmentation);
    watch.report({"planes", 1, 1});
    return segments;
  });
  py::list list;
  for (const PlaneSegment& segment : found.planes)
    list.append(planeDict(segment.plane, segment.points, search->cloud));
  return list;
}
} // namespace

void
bindPlanes(py::module_& module)
{
  module.def("planes", &findPlanes);
}

} // namespace pcl6d::python
