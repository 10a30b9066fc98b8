// SPDX-License-Identifier: BSD-3-Clause
#include "pcd_body.h"
#include "text.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/pcd_io.h>

#include <algorithm>
#include <ostream>

namespace pcl6d {

namespace {

/** Checks that the fields lie inside the points and the points inside the data. */
void
checkCloud(const pcl::PCLPointCloud2& cloud)
{
  const std::size_t points = std::size_t{cloud.width} * cloud.height;
  if (cloud.data.size() != points * cloud.point_step)
    throw BadArgument("the cloud holds " + text::counted(cloud.data.size(), "byte") +
                      ", but " + text::counted(points, "point") + " of " +
                      text::counted(cloud.point_step, "byte"));
  if (std::all_of(cloud.fields.begin(), cloud.fields.end(), isPadding))
    throw BadArgument("the cloud has no field");
  for (const auto& field : cloud.fields) {
    const std::size_t size = sizeOfType(field.datatype);
    if (!isPadding(field) &&
        (size == 0 || field.offset + size * field.count > cloud.point_step))
      throw BadArgument("field '" + field.name +
                        "' of the cloud has an unknown type or "
                        "does not fit into a point");
  }
}

/** \return the header of a file without gaps between the fields */
PcdHeader
headerFor(const pcl::PCLPointCloud2& cloud)
{
  PcdHeader header;
  header.width = cloud.width;
  header.height = cloud.height;
  for (auto field : cloud.fields) {
    if (isPadding(field))
      continue;
    field.count = std::max<pcl::uindex_t>(field.count, 1); // 0 in old clouds
    field.offset = static_cast<pcl::uindex_t>(header.point_size);
    header.point_size += field.count * sizeOfType(field.datatype);
    header.fields.push_back(field);
  }
  return header;
}

/** \return the points of the cloud in the header's layout */
std::vector<std::uint8_t>
packed(const pcl::PCLPointCloud2& cloud, const PcdHeader& header)
{
  std::vector<std::uint8_t> points(header.numPoints() * header.point_size);
  auto target = header.fields.begin();
  for (const auto& field : cloud.fields) {
    if (isPadding(field))
      continue;
    const std::size_t size = target->count * sizeOfType(field.datatype);
    for (std::size_t i = 0; i < header.numPoints(); ++i)
      std::copy_n(&cloud.data[i * cloud.point_step + field.offset],
                  size,
                  &points[i * header.point_size + target->offset]);
    ++target;
  }
  return points;
}

} // namespace

void
writePcd(const std::filesystem::path& path,
         const pcl::PCLPointCloud2& cloud,
         const Eigen::Isometry3d& T_world_scan,
         PcdEncoding encoding)
{
  checkCloud(cloud);
  PcdHeader header = headerFor(cloud);
  header.viewpoint = T_world_scan;
  header.encoding = encoding;
  if (encoding == PcdEncoding::kAscii)
    for (auto& field : header.fields) // packed colours: as a float, many are nan
      if ((field.name == "rgb" || field.name == "rgba") &&
          field.datatype == pcl::PCLPointField::FLOAT32)
        field.datatype = pcl::PCLPointField::UINT32;
  const std::string body = encodePcdBody(path, header, packed(cloud, header));
  writeFileAtomically(path, [&](std::ostream& stream) {
    stream << toString(header);
    stream.write(body.data(), static_cast<std::streamsize>(body.size()));
  });
}

Eigen::Isometry3d
readPcdViewpoint(const std::filesystem::path& path)
{
  std::ifstream stream = text::open(path);
  return readPcdHeader(stream, path).viewpoint;
}

pcl::PCLPointCloud2
readPcd(const std::filesystem::path& path)
{
  std::ifstream stream = text::open(path);
  const PcdHeader header = readPcdHeader(stream, path);
  text::Input input(std::move(stream), path, header.num_lines);
  return decodePcdBody(input, header);
}

} // namespace pcl6d
