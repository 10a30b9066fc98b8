// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/polygon.h>
#include <pcl6d/common/require.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/label_colours.h>
#include <pcl6d/io/plane_mesh_io.h>
#include <pcl6d/io/scan_writer.h>

#include <cstring>
#include <ostream>

namespace pcl6d {
namespace {
template <typename T>
void
append(std::string& bytes, const T& value)
{
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

void
appendColour(std::string& bytes, const std::string& label)
{
  for (const std::uint8_t channel : labelColour(label))
    append(bytes, channel);
}

std::string
plyHeader(std::size_t num_vertices, std::size_t num_faces)
{
  const std::string colour =
      "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  return "ply\nformat binary_little_endian 1.0\nelement vertex " +
         std::to_string(num_vertices) +
         "\nproperty float x\nproperty float y\nproperty float z\n" + colour +
         "element face " + std::to_string(num_faces) +
         "\nproperty list uchar int vertex_indices\n" + colour +
         "property int plane_id\nend_header\n";
}

pcl::PCLPointField
field(const char* name, std::uint32_t offset, std::uint8_t datatype)
{
  pcl::PCLPointField result;
  result.name = name;
  result.offset = offset;
  result.datatype = datatype;
  result.count = 1;
  return result;
}
} // namespace

void
writePolygonMesh(const std::filesystem::path& path,
                 const std::vector<LabelledPolygon>& polygons)
{
  std::string vertices, faces;
  std::int32_t num_vertices = 0, plane_id = 0;
  std::size_t num_faces = 0;
  for (const auto& polygon : polygons) {
    ++plane_id;
    for (const auto& triangle : triangulate(polygon.rings, polygon.normal)) {
      append(faces, std::uint8_t{3});
      for (const auto corner : triangle)
        append(faces, num_vertices + static_cast<std::int32_t>(corner));
      appendColour(faces, polygon.label);
      append(faces, plane_id);
      ++num_faces;
    }
    for (const auto& ring : polygon.rings)
      for (const auto& corner : ring) {
        for (int axis = 0; axis < 3; ++axis)
          append(vertices, static_cast<float>(corner[axis]));
        appendColour(vertices, polygon.label);
        ++num_vertices;
      }
  }
  const std::string header =
      plyHeader(static_cast<std::size_t>(num_vertices), num_faces);
  writeFileAtomically(
      path, [&](std::ostream& stream) { stream << header << vertices << faces; });
}

void
writeLabelledPoints(const std::filesystem::path& path,
                    const Points& points,
                    const std::vector<std::uint32_t>& label_of,
                    const std::vector<PointLabel>& labels)
{
  using pcl::PCLPointField;
  require(label_of.size() == points.size(),
          "number of labels",
          label_of.size(),
          "that of the points, " + std::to_string(points.size()));
  pcl::PCLPointCloud2 cloud;
  cloud.fields = {field("x", 0, PCLPointField::FLOAT32),
                  field("y", 4, PCLPointField::FLOAT32),
                  field("z", 8, PCLPointField::FLOAT32),
                  field("rgb", 12, PCLPointField::FLOAT32),
                  field("plane_id", 16, PCLPointField::UINT32),
                  field("label", 20, PCLPointField::UINT32)};
  cloud.point_step = 24;
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(points.size());
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.is_dense = 1;
  cloud.data.resize(std::size_t{cloud.point_step} * points.size());
  std::uint8_t* out = cloud.data.data();
  for (std::size_t i = 0; i < points.size(); ++i, out += cloud.point_step) {
    require(label_of[i] < labels.size(),
            "place of a label",
            label_of[i],
            "below " + std::to_string(labels.size()));
    const PointLabel& label = labels[label_of[i]];
    const auto colour = labelColour(label.name);
    const std::uint32_t packed =
        std::uint32_t{colour[0]} << 16 | std::uint32_t{colour[1]} << 8 | colour[2];
    std::memcpy(out, points[i].data(), 12);
    std::memcpy(out + 12, &packed, 4);
    std::memcpy(out + 16, &label.plane_id, 4);
    std::memcpy(out + 20, &label.label, 4);
  }
  writeScan(path, cloud);
}

} // namespace pcl6d
