// SPDX-License-Identifier: BSD-3-Clause
#include "arrays.h"
#include "bindings.h"
#include "long_call.h"
#include "options.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/filters/point_normals.h>
#include <pcl6d/filters/voxel_reduction.h>
#include <pcl6d/search/point_tree.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <pybind11/stl.h>

namespace pcl6d::python {

namespace {
/** An immutable search tree, safe for concurrent queries from threads of Python. */
struct Tree {
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  PointTree points;
};

std::shared_ptr<Tree>
makeTree(const py::object& points,
         const py::object& threads,
         const py::object& progress)
{
  const auto num_threads =
      valueOf<unsigned int>(threads, "num_threads", "a whole number >= 0");
  const auto cloud = std::make_shared<Cloud>(cloudOf(points, "points"));
  return longCall(progress, [cloud, num_threads](CallWatch& watch) {
    watch.report({"building", 0, 1});
    auto tree = std::make_shared<Tree>();
    tree->offset = cloud->offset;
    tree->points = PointTree(cloud->points, num_threads);
    return tree;
  });
}

/** Neighbours of many queries, k to a row. */
struct Neighbours {
  std::vector<double> distances;
  std::vector<std::int64_t> indices;
};

Neighbours
nearest(const Tree& tree, const Points& queries, std::size_t k, double max_distance)
{
  Neighbours found;
  found.distances.assign(queries.size() * k, std::numeric_limits<double>::infinity());
  found.indices.assign(queries.size() * k, -1);
  constexpr std::size_t kBlock = 1024;
  parallelBlocks(queries.size(), kBlock, 0, [&](const Block& block) {
    std::vector<Neighbour> row(k);
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const std::size_t count = tree.points.nearestK(queries[i], k, row.data());
      for (std::size_t j = 0; j < count; ++j) {
        const double distance = std::sqrt(static_cast<double>(row[j].distance_sq));
        if (row[j].index < 0 || distance > max_distance)
          break;
        found.distances[i * k + j] = distance;
        found.indices[i * k + j] = row[j].index;
      }
    }
  });
  return found;
}

py::tuple
queryTree(const std::shared_ptr<Tree>& tree,
          const py::object& queries,
          const py::object& count,
          const py::object& limit,
          const py::object& progress)
{
  const auto k = valueOf<std::size_t>(count, "k", "a whole number >= 1");
  const auto max_distance = valueOf<double>(limit, "max_distance", "a number >= 0");
  require(k >= 1, "k", k, ">= 1");
  require(max_distance >= 0, "max_distance", max_distance, ">= 0");
  const auto cloud =
      std::make_shared<Cloud>(cloudAbout(queries, "queries", tree->offset));
  const std::size_t columns =
      std::min(k, std::max<std::size_t>(1, tree->points.size()));
  const auto found =
      longCall(progress, [tree, cloud, columns, max_distance](CallWatch& watch) {
        watch.report({"searching", 0, 1});
        return nearest(*tree, cloud->points, columns, max_distance);
      });
  const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(cloud->points.size()),
                                       static_cast<py::ssize_t>(columns)};
  return py::make_tuple(arrayOf(found.distances).reshape(shape),
                        arrayOf(found.indices).reshape(shape));
}

py::tuple
queryRadius(const std::shared_ptr<Tree>& tree,
            const py::object& query,
            const py::object& limit)
{
  const auto radius = valueOf<double>(limit, "radius", "a number >= 0");
  require(radius >= 0, "radius", radius, ">= 0");
  const Eigen::Vector3f place =
      (positionOf(query, "query") - tree->offset).cast<float>();
  std::vector<Neighbour> found;
  {
    const py::gil_scoped_release release;
    found = tree->points.withinRadius(place, static_cast<float>(radius * radius));
  }
  std::vector<double> distances;
  std::vector<std::int64_t> indices;
  for (const Neighbour& neighbour : found) {
    distances.push_back(std::sqrt(static_cast<double>(neighbour.distance_sq)));
    indices.push_back(neighbour.index);
  }
  return py::make_tuple(arrayOf(distances), arrayOf(indices));
}

py::array
downsample(const py::object& points, const py::dict& values, const py::object& progress)
{
  ReductionOptions reduction;
  Options options(values);
  options.number("voxel", reduction.voxel);
  options.word("method", reduction.method, reductionMethodFromName);
  options.take<int>("points_per_voxel", "a whole number", reduction.points_per_voxel);
  options.take<std::uint64_t>("seed", "a whole number >= 0", reduction.seed);
  options.requireKnown();
  reduction.validate();
  const auto cloud = std::make_shared<Cloud>(cloudOf(points, "points"));
  const Points reduced = longCall(progress, [cloud, reduction](CallWatch& watch) {
    watch.report({"reducing", 0, 1});
    return reducePoints(cloud->points, reduction);
  });
  return rowsOf(reduced, *cloud);
}

py::array
normals(const py::object& points, const py::dict& values, const py::object& progress)
{
  std::size_t neighbours = 20;
  unsigned int num_threads = 0;
  py::object viewpoint = py::make_tuple(0.0, 0.0, 0.0);
  Options options(values);
  options.count("neighbours", neighbours);
  options.count("num_threads", num_threads);
  options.take<py::object>("viewpoint", "a position", viewpoint);
  options.requireKnown();
  const Eigen::Vector3d scanner = positionOf(viewpoint, "viewpoint");
  const auto cloud = std::make_shared<Cloud>(cloudOf(points, "points"));
  return arrayOf(
      longCall(progress, [cloud, neighbours, num_threads, scanner](CallWatch& watch) {
        watch.report({"normals", 0, 1});
        const Eigen::Vector3d place = scanner - cloud->offset;
        Normals found = estimateNormals(cloud->points,
                                        PointTree(cloud->points, num_threads),
                                        neighbours,
                                        num_threads);
        for (std::size_t i = 0; i < found.size(); ++i)
          if (found[i].cast<double>().dot(place - cloud->points[i].cast<double>()) < 0)
            found[i] = -found[i];
        return found;
      }));
}
} // namespace

void
bindPointTools(py::module_& module)
{
  py::class_<Tree, std::shared_ptr<Tree>>(module, "Tree")
      .def(py::init(&makeTree))
      .def("size", [](const Tree& tree) { return tree.points.size(); })
      .def("query", &queryTree)
      .def("query_radius", &queryRadius);
  module.def("voxel_downsample", &downsample);
  module.def("estimate_normals", &normals);
}

} // namespace pcl6d::python
