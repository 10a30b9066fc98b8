// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/simulation/truth_fields.h>

#include <cmath>
#include <cstring>

namespace pcl6d {
namespace {
constexpr std::size_t kFieldSize = sizeof(std::uint32_t);
constexpr std::array<const char*, 3> kFields = {"plane_id", "object_id", "label"};

// The surface under a sample; an empty surface without return.
const Surface&
surfaceOf(const RangeSample& sample, const TriangleScene& scene)
{
  static const Surface kNothing;
  return std::isfinite(sample.range)
             ? scene.surfaces[scene.triangles[sample.triangle].surface]
             : kNothing;
}

void
count(std::vector<std::size_t>& counts, std::uint32_t id)
{
  if (id >= counts.size())
    counts.resize(id + 1, 0);
  ++counts[id];
}
} // namespace

void
addTruthFields(pcl::PCLPointCloud2& cloud,
               const RangeScan& scan,
               const TriangleScene& scene)
{
  const std::size_t size = scan.samples.size();
  require(static_cast<std::size_t>(cloud.width) * cloud.height == size,
          "number of points",
          static_cast<std::size_t>(cloud.width) * cloud.height,
          "the scan's number of samples");
  const std::size_t before = cloud.point_step;
  for (const auto* name : kFields) {
    pcl::PCLPointField field;
    field.name = name;
    field.offset = cloud.point_step;
    field.datatype = pcl::PCLPointField::UINT32;
    field.count = 1;
    cloud.fields.push_back(field);
    cloud.point_step += static_cast<pcl::uindex_t>(kFieldSize);
  }
  std::vector<std::uint8_t> data(size * cloud.point_step);
  for (std::size_t i = 0; i < size; ++i) {
    const Surface& surface = surfaceOf(scan.samples[i], scene);
    const std::array<std::uint32_t, 3> values = {
        surface.plane, surface.object, static_cast<std::uint32_t>(surface.label)};
    std::uint8_t* const point = &data[i * cloud.point_step];
    std::memcpy(point, &cloud.data[i * before], before);
    std::memcpy(point + before, values.data(), sizeof values);
  }
  cloud.data = std::move(data);
  cloud.row_step = cloud.width * cloud.point_step;
}

std::size_t
addDynamicField(pcl::PCLPointCloud2& cloud,
                const RangeScan& scan,
                const MovingScene& scene)
{
  std::vector<double> values;
  std::size_t moving = 0;
  for (const auto& sample : scan.samples) {
    const bool moves = std::isfinite(sample.range) && scene.moves(sample.triangle);
    values.push_back(moves ? 1 : 0);
    moving += moves ? 1 : 0;
  }
  addField(cloud, "dynamic", pcl::PCLPointField::UINT32, values);
  return moving;
}

void
TruthCounts::add(const RangeScan& scan, const TriangleScene& scene)
{
  for (const auto& sample : scan.samples) {
    const Surface& surface = surfaceOf(sample, scene);
    count(planes, surface.plane);
    count(objects, surface.object);
  }
}

} // namespace pcl6d
