// SPDX-License-Identifier: BSD-3-Clause
// Definitions: sensor_msgs of ROS 1 and 2, livox_ros_driver2.
#include "bag/messages/cloud_messages.h"

#include <pcl6d/io/scan_fields.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace pcl6d::sources {

namespace {
using pcl::PCLPointField;

constexpr const char* kPointCloudType = "sensor_msgs/PointCloud2";
constexpr const char* kLaserScanType = "sensor_msgs/LaserScan";
constexpr const char* kLivoxTypes[] = {"livox_ros_driver/CustomMsg",
                                       "livox_ros_driver2/CustomMsg",
                                       "livox_interfaces/CustomMsg"};
constexpr double kOneNanosecond = 1e-9; // [s]
constexpr float kNoReturn = std::numeric_limits<float>::quiet_NaN();

bool
isLivoxType(const std::string& type)
{
  return std::find(std::begin(kLivoxTypes), std::end(kLivoxTypes), type) !=
         std::end(kLivoxTypes);
}

/** \return [byte]; 0: unknown type */
std::size_t
sizeOfDatatype(std::uint8_t datatype)
{
  constexpr std::size_t kSizes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};
  return datatype < std::size(kSizes) ? kSizes[datatype] : 0;
}

/** \brief The values of a PointCloud2 ahead of the points. */
struct PointCloudHead {
  MessageHeader header;
  std::uint32_t height = 0, width = 0;
  std::vector<PCLPointField> fields;
  std::uint64_t
  numPoints() const
  {
    return std::uint64_t{height} * width;
  }
};

PointCloudHead
readPointCloudHead(MessageReader& reader)
{
  PointCloudHead head;
  head.header = reader.header();
  head.height = reader.number<std::uint32_t>();
  head.width = reader.number<std::uint32_t>();
  constexpr std::size_t kLeastField = 13; // [byte] an empty name and three numbers
  head.fields.resize(reader.count(kLeastField));
  for (PCLPointField& field : head.fields) {
    field.name = plainName(reader.string(), " "); // no field of a file has blanks
    field.offset = reader.number<std::uint32_t>();
    field.datatype = reader.number<std::uint8_t>();
    field.count =
        std::max(1u, reader.number<std::uint32_t>()); // some drivers write 0 for 1
  }
  return head;
}

/** \brief A field of the message with its position in the cloud. */
struct CopiedField {
  std::size_t from = 0, to = 0; ///< [byte] in a point
  std::size_t size = 0;         ///< [byte] of an element
  std::size_t count = 0;        ///< of elements
};

/** Lays out a cloud with the named fields side by side. */
std::vector<CopiedField>
layOut(const PointCloudHead& head,
       std::uint32_t point_step,
       const MessageReader& reader,
       pcl::PCLPointCloud2& cloud)
{
  std::vector<CopiedField> copied;
  std::set<std::string> names;
  cloud.point_step = 0;
  for (PCLPointField field : head.fields) {
    const std::size_t size = sizeOfDatatype(field.datatype);
    const std::uint64_t end = field.offset + std::uint64_t{size} * field.count;
    if (size == 0)
      reader.fail("field " + text::quoted(field.name) + " has the datatype " +
                  std::to_string(field.datatype) + ", but 1 to 8 are known");
    if (end > point_step)
      reader.fail("field " + text::quoted(field.name) + " ends at byte " +
                  std::to_string(end) + " of a point of " + std::to_string(point_step));
    if (field.name.empty() || field.name == "_") // room between fields
      continue;
    if (!names.insert(field.name).second)
      reader.fail("has two fields " + text::quoted(field.name));
    copied.push_back({field.offset, cloud.point_step, size, field.count});
    field.offset = cloud.point_step;
    cloud.point_step += static_cast<pcl::uindex_t>(size * field.count);
    cloud.fields.push_back(field);
  }
  for (const char* const axis : {"x", "y", "z"}) {
    const auto found =
        std::find_if(cloud.fields.begin(), cloud.fields.end(), [&](const auto& field) {
          return field.name == axis;
        });
    if (found == cloud.fields.end() || (found->datatype != PCLPointField::FLOAT32 &&
                                        found->datatype != PCLPointField::FLOAT64))
      reader.fail(std::string("has no field ") + axis +
                  " of type float32 or float64: choose another topic by --topic");
  }
  return copied;
}

void
copyPoint(const std::uint8_t* from,
          std::uint8_t* to,
          const std::vector<CopiedField>& fields,
          bool is_big_endian)
{
  for (const CopiedField& field : fields)
    if (!is_big_endian)
      std::memcpy(to + field.to, from + field.from, field.size * field.count);
    else
      for (std::size_t k = 0; k < field.count; ++k) {
        const std::uint8_t* const element = from + field.from + k * field.size;
        std::reverse_copy(
            element, element + field.size, to + field.to + k * field.size);
      }
}

ScanCloud
readPointCloud(MessageReader& reader)
{
  const PointCloudHead head = readPointCloudHead(reader);
  const bool is_big_endian = reader.number<std::uint8_t>() != 0;
  const auto point_step = reader.number<std::uint32_t>();
  const auto row_step = reader.number<std::uint32_t>();
  ScanCloud scan;
  pcl::PCLPointCloud2& cloud = scan.cloud;
  const auto fields = layOut(head, point_step, reader, cloud);
  const std::uint64_t row = std::uint64_t{head.width} * point_step;
  if (head.height > 1 && row_step < row)
    reader.fail("its rows have " + std::to_string(row_step) + " bytes, but " +
                std::to_string(head.width) + " points take " + std::to_string(row));
  const std::uint64_t stride = head.height > 1 ? row_step : row;
  const Bytes data = reader.bytes(reader.count(1));
  if (head.numPoints() > 0 &&
      (data.size < row || (data.size - row) / std::max<std::uint64_t>(stride, 1) <
                              std::uint64_t{head.height} - 1))
    reader.fail(std::to_string(head.numPoints()) +
                " points are announced, but the data has " + std::to_string(data.size) +
                " bytes");
  cloud.height = head.height;
  cloud.width = head.width;
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.is_bigendian = false;
  cloud.is_dense = false;
  cloud.data.resize(head.numPoints() * cloud.point_step);
  const bool is_packed =
      !is_big_endian && cloud.point_step == point_step &&
      std::all_of(fields.begin(), fields.end(), [](const auto& field) {
        return field.from == field.to;
      });
  std::uint8_t* to = cloud.data.data();
  for (std::uint64_t y = 0; y < head.height && row > 0; ++y) {
    const std::uint8_t* const from = data.data + y * stride;
    if (is_packed)
      std::memcpy(to + y * row, from, row);
    else
      for (std::uint64_t x = 0; x < head.width; ++x)
        copyPoint(from + x * point_step,
                  to + (y * head.width + x) * cloud.point_step,
                  fields,
                  is_big_endian);
  }
  return scan;
}

/** \brief Points with fields filled individually. */
struct PointColumns {
  std::vector<double> x, y, z, intensity, time;

  ScanCloud
  cloud() const
  {
    ScanCloud scan;
    scan.cloud.height = 1;
    scan.cloud.width = static_cast<pcl::uindex_t>(x.size());
    scan.cloud.is_dense = false;
    addField(scan.cloud, "x", PCLPointField::FLOAT32, x);
    addField(scan.cloud, "y", PCLPointField::FLOAT32, y);
    addField(scan.cloud, "z", PCLPointField::FLOAT32, z);
    if (intensity.size() == x.size())
      addField(scan.cloud, "intensity", PCLPointField::FLOAT32, intensity);
    if (time.size() == x.size())
      addField(scan.cloud, "time", PCLPointField::FLOAT32, time);
    return scan;
  }
};

/** \brief CustomMsg of Livox ahead of the points. */
struct LivoxHead {
  MessageHeader header;
  double base = 0; ///< [s] from the stamp to the time base of the points
  std::uint32_t count = 0;
};

LivoxHead
readLivoxHead(MessageReader& reader)
{
  LivoxHead head;
  head.header = reader.header();
  const auto timebase = static_cast<std::int64_t>(reader.number<std::uint64_t>());
  reader.number<std::uint32_t>();         // number of points, repeated in the list
  reader.bytes(4);                        // lidar, reserved
  constexpr std::size_t kLivoxPoint = 19; // [byte]
  head.count = reader.count(kLivoxPoint);
  // A base on another clock, such as the sensor's uptime, is ignored.
  constexpr double kSameClock = 1; // [s]
  const double base =
      (static_cast<double>(timebase) - static_cast<double>(head.header.stamp)) *
      kOneNanosecond;
  if (std::abs(base) <= kSameClock)
    head.base = static_cast<double>(timebase - head.header.stamp) * kOneNanosecond;
  return head;
}

ScanCloud
readLivox(MessageReader& reader)
{
  const LivoxHead head = readLivoxHead(reader);
  PointColumns points;
  std::vector<double> tags, lines;
  for (std::uint32_t i = 0; i < head.count; ++i) {
    points.time.push_back(head.base + kOneNanosecond * reader.number<std::uint32_t>());
    points.x.push_back(reader.number<float>());
    points.y.push_back(reader.number<float>());
    points.z.push_back(reader.number<float>());
    points.intensity.push_back(reader.number<std::uint8_t>());
    tags.push_back(reader.number<std::uint8_t>());
    lines.push_back(reader.number<std::uint8_t>());
  }
  ScanCloud scan = points.cloud();
  addField(scan.cloud, "tag", PCLPointField::UINT8, tags);
  addField(scan.cloud, "line", PCLPointField::UINT8, lines);
  return scan;
}

/** \brief LaserScan ahead of the ranges. */
struct LaserScanHead {
  MessageHeader header;
  float first = 0, step = 0;       ///< [rad]
  float time_step = 0;             ///< [s]
  float nearest = 0, farthest = 0; ///< [m]
  std::uint32_t count = 0;
};

LaserScanHead
readLaserScanHead(MessageReader& reader)
{
  LaserScanHead head;
  head.header = reader.header();
  head.first = reader.number<float>();
  reader.number<float>(); // last angle
  head.step = reader.number<float>();
  head.time_step = reader.number<float>();
  reader.number<float>(); // time of the scan
  head.nearest = reader.number<float>();
  head.farthest = reader.number<float>();
  head.count = reader.count(sizeof(float));
  return head;
}

ScanCloud
readLaserScan(MessageReader& reader)
{
  const LaserScanHead head = readLaserScanHead(reader);
  PointColumns points;
  for (std::uint32_t i = 0; i < head.count; ++i) {
    const auto range = reader.number<float>();
    const bool is_return = range >= head.nearest && range <= head.farthest;
    const double angle = double{head.first} + i * double{head.step};
    points.x.push_back(is_return ? range * std::cos(angle) : kNoReturn);
    points.y.push_back(is_return ? range * std::sin(angle) : kNoReturn);
    points.z.push_back(0);
    if (head.time_step > 0)
      points.time.push_back(i * double{head.time_step});
  }
  const std::uint32_t intensities = reader.count(sizeof(float));
  for (std::uint32_t i = 0; intensities == head.count && i < intensities; ++i)
    points.intensity.push_back(reader.number<float>());
  return points.cloud();
}
} // namespace

bool
isCloudType(const std::string& type)
{
  return type == kPointCloudType || isLivoxType(type);
}

bool
isPlanarType(const std::string& type)
{
  return type == kLaserScanType;
}

CloudHead
readCloudHead(const std::string& type, MessageReader& reader)
{
  if (isLivoxType(type)) {
    const LivoxHead head = readLivoxHead(reader);
    return {
        head.header, head.count, {"x", "y", "z", "intensity", "time", "tag", "line"}};
  }
  if (isPlanarType(type)) {
    const LaserScanHead head = readLaserScanHead(reader);
    return {head.header, head.count, {}};
  }
  const PointCloudHead head = readPointCloudHead(reader);
  CloudHead cloud{head.header, head.numPoints(), {}};
  for (const PCLPointField& field : head.fields)
    cloud.fields.push_back(field.name);
  return cloud;
}

ScanCloud
readCloudMessage(const std::string& type, MessageReader& reader)
{
  if (isLivoxType(type))
    return readLivox(reader);
  return isPlanarType(type) ? readLaserScan(reader) : readPointCloud(reader);
}

} // namespace pcl6d::sources
