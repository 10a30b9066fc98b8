// SPDX-License-Identifier: BSD-3-Clause
#include "bindings.h"
#include "long_call.h"
#include "scans.h"

#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_writer.h>
#include <pcl6d/sources/open_source.h>

#include <pcl/PCLPointField.h>

#include <cstring>
#include <memory>
#include <pybind11/stl.h>

namespace pcl6d::python {

std::filesystem::path
pathOf(const py::object& value, const std::string& name)
{
  const auto path = py::reinterpret_steal<py::object>(PyOS_FSPath(value.ptr()));
  if (!path) {
    PyErr_Clear();
    throw BadArgument(name + " = " + std::string(py::repr(value)) +
                      ", but must be a str or os.PathLike");
  }
  const auto bytes = py::reinterpret_steal<py::bytes>(
      py::isinstance<py::bytes>(path) ? path.inc_ref().ptr()
                                      : PyUnicode_EncodeFSDefault(path.ptr()));
  if (!bytes)
    throw py::error_already_set();
  const std::string text = bytes;
  if (text.empty() || text.find('\0') != std::string::npos)
    throw BadArgument(name + " is empty or has a zero byte, but must be a path");
  return text;
}

ScanFolderOptions
folderOptions(Options& options)
{
  ScanFolderOptions folder;
  options.word("format", folder.format, scanFormatFromName);
  py::object poses = py::none();
  options.take<py::object>("poses", "a path", poses);
  if (!poses.is_none())
    folder.poses_file = pathOf(poses, "poses");
  options.take<int>("first", "a whole number", folder.first);
  options.take<int>("last", "a whole number", folder.last);
  options.take<int>("every", "a whole number", folder.every);
  return folder;
}

py::object
fieldOrNone(const pcl::PCLPointCloud2& cloud, const char* name)
{
  const auto field = fieldValues(cloud, name);
  if (!field)
    return py::none();
  return arrayOf(std::vector<float>(field->values.begin(), field->values.end()));
}

namespace {
using Folder = std::shared_ptr<ScanFolder>;

Folder
openFolder(const py::object& name, const py::dict& values, const py::object& progress)
{
  Options options(values);
  const ScanFolderOptions folder = folderOptions(options);
  options.requireKnown();
  const std::filesystem::path path = pathOf(name, "path");
  return longCall(progress, [path, folder](CallWatch& watch) {
    watch.report({"opening", 0, 1});
    return std::make_shared<ScanFolder>(std::filesystem::is_regular_file(path)
                                            ? openFileList({path}, folder)
                                            : openScanFiles({path}, folder));
  });
}

/** Points are near the origin, in the frame of the folder; `initial_pose` is in the same frame. */
py::dict
readOne(const Folder& folder, std::size_t i, const py::object& progress)
{
  if (i >= folder->size())
    throw py::index_error("scan " + std::to_string(i) + " of " +
                          std::to_string(folder->size()));
  const Scan scan = longCall(progress, [folder, i](CallWatch& watch) {
    watch.report({"reading", 0, 1});
    return folder->read(i);
  });
  py::dict dict;
  dict["name"] = folder->name(i);
  dict["index"] = folder->index(i);
  dict["points"] = arrayOf(scan.points);
  dict["initial_pose"] = arrayOf(folder->initialPose(i));
  dict["stamp"] = folder->stamps().empty()
                      ? py::object(py::none())
                      : py::object(py::float_(folder->stamps()[i]));
  dict["intensity"] = fieldOrNone(scan.cloud, "intensity");
  dict["num_dropped"] = scan.dropped;
  return dict;
}

/** \return a cloud with x, y, z of the type of the array */
pcl::PCLPointCloud2
cloudOfRows(const Cloud& rows)
{
  pcl::PCLPointCloud2 cloud;
  const std::size_t size = rows.is_double ? sizeof(double) : sizeof(float);
  for (const char* name : {"x", "y", "z"}) {
    pcl::PCLPointField field;
    field.name = name;
    field.offset = static_cast<std::uint32_t>(cloud.fields.size() * size);
    field.datatype =
        rows.is_double ? pcl::PCLPointField::FLOAT64 : pcl::PCLPointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
  }
  cloud.point_step = static_cast<std::uint32_t>(3 * size);
  cloud.width = static_cast<std::uint32_t>(rows.points.size());
  cloud.height = 1;
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.data.resize(std::size_t{cloud.point_step} * cloud.width);
  auto* out = cloud.data.data();
  for (const auto& p : rows.points)
    for (int axis = 0; axis < 3; ++axis, out += size) {
      const double value = static_cast<double>(p[axis]) + rows.offset[axis];
      if (rows.is_double)
        std::memcpy(out, &value, size);
      else
        std::memcpy(out, &p[axis], size);
    }
  return cloud;
}

std::vector<std::string>
writeCloud(const py::object& path,
           const py::object& points,
           const py::object& pose,
           const py::dict& values,
           const py::object& progress)
{
  std::vector<double> intensity;
  ScanWriterOptions writer;
  Options options(values);
  options.word("format", writer.format, scanFormatFromName);
  options.take<std::vector<double>>("intensity", "a number for each point", intensity);
  options.requireKnown();
  const std::filesystem::path file = pathOf(path, "path");
  const Eigen::Isometry3d T_world_scan = poseOf(pose, "pose");
  auto cloud =
      std::make_shared<pcl::PCLPointCloud2>(cloudOfRows(cloudOf(points, "points")));
  if (!intensity.empty() && intensity.size() != cloud->width)
    throw BadArgument("intensity has " + std::to_string(intensity.size()) +
                      " numbers, but must have a number for each of " +
                      std::to_string(cloud->width) + " points");
  if (!intensity.empty())
    addField(*cloud, "intensity", pcl::PCLPointField::FLOAT32, intensity);
  return longCall(progress, [cloud, file, T_world_scan, writer](CallWatch& watch) {
    watch.report({"writing", 0, 1});
    return writeScan(file, *cloud, T_world_scan, writer);
  });
}
} // namespace

void
bindScans(py::module_& module)
{
  py::class_<ScanFolder, Folder>(module, "Folder")
      .def(py::init(&openFolder))
      .def("size", &ScanFolder::size)
      .def("read", &readOne)
      .def("pose_source", [](const ScanFolder& folder) { return folder.poseSource(); })
      .def("note", [](const ScanFolder& folder) { return folder.coordinates(); });
  module.def("write_map", &writeCloud);
}

} // namespace pcl6d::python
