// SPDX-License-Identifier: BSD-3-Clause
#include "scan/las/las_header.h"
#include "scan/las/laz_reader.h"
#include "scan/scan_formats.h"

#include <algorithm>
#include <cmath>

namespace pcl6d::io {

namespace {

using pcl::PCLPointField;

constexpr std::size_t kAtOnce = 1 << 14;   // points read before conversion
constexpr float kDegreesPerAngle = 0.006F; // of formats 6 to 10
constexpr double kNear = 500; // [m] beyond, float resolves less than 0.03 mm

/** \brief Turns records of points into points of a cloud. */
class LasPoints {
public:
  LasPoints(const LasHeader& header, bool in_double)
  : header_(header), in_double_(in_double)
  {
    const std::uint8_t type =
        in_double ? PCLPointField::FLOAT64 : PCLPointField::FLOAT32;
    for (const char* const axis : {"x", "y", "z"})
      addField(axis, type, in_double ? 8 : 4);
    addField("intensity", PCLPointField::FLOAT32, 4);
    if (header.layout.colours > 0)
      rgb_ = addField("rgb", PCLPointField::FLOAT32, 4);
    if (header.layout.time > 0)
      time_ = addField("gps_time", PCLPointField::FLOAT64, 8);
    rest_ = addField("scan_angle", PCLPointField::FLOAT32, 4);
    addField("point_source_id", PCLPointField::UINT16, 2);
    if (header.layout.infrared > 0)
      infrared_ = addField("nir", PCLPointField::UINT16, 2);
    bytes_ = addField("return_number", PCLPointField::UINT8, 1);
    addField("number_of_returns", PCLPointField::UINT8, 1);
    addField("classification", PCLPointField::UINT8, 1);
    addField("user_data", PCLPointField::UINT8, 1);
  }

  void
  reserve(std::size_t count)
  {
    scan_.cloud.data.reserve(count * scan_.cloud.point_step);
  }

  void
  add(const std::uint8_t* record)
  {
    if (isDeleted(record)) {
      ++num_deleted_;
      return;
    }
    auto& data = scan_.cloud.data;
    const std::size_t begin = data.size();
    data.resize(begin + scan_.cloud.point_step);
    std::uint8_t* const point = &data[begin];
    storePlace(record, point);
    if (header_.layout.colours > 0)
      storeColours(record + header_.layout.colours, point);
    if (header_.layout.time > 0)
      std::memcpy(point + time_, record + header_.layout.time, 8);
    if (header_.layout.infrared > 0)
      std::memcpy(point + infrared_, record + header_.layout.infrared, 2);
    header_.layout.is_new ? storeNew(record, point) : storeOld(record, point);
  }

  ScanCloud
  finish()
  {
    pcl::PCLPointCloud2& cloud = scan_.cloud;
    cloud.height = 1;
    cloud.width = static_cast<pcl::uindex_t>(cloud.data.size() / cloud.point_step);
    cloud.row_step = cloud.width * cloud.point_step;
    cloud.is_dense = false;
    if (header_.layout.colours > 0)
      packColours();
    scan_.left_out = header_.left_out;
    if (num_deleted_ > 0)
      scan_.left_out.push_back(text::counted(num_deleted_, "point") +
                               " marked as deleted ('withheld')");
    return std::move(scan_);
  }

private:
  std::size_t
  addField(const char* name, std::uint8_t datatype, std::size_t size)
  {
    PCLPointField field;
    field.name = name;
    field.offset = scan_.cloud.point_step;
    field.datatype = datatype;
    field.count = 1;
    scan_.cloud.fields.push_back(field);
    scan_.cloud.point_step += static_cast<pcl::uindex_t>(size);
    return field.offset;
  }

  bool
  isDeleted(const std::uint8_t* record) const
  {
    if (header_.layout.is_new)
      return (record[15] & 4) != 0;
    return header_.minor > 0 && (record[15] & 128) != 0; // version 1.0 has no flag
  }

  void
  storePlace(const std::uint8_t* record, std::uint8_t* point) const
  {
    for (Eigen::Index axis = 0; axis < 3; ++axis, record += 4) {
      const double value =
          header_.offset[axis] + header_.scale[axis] * lasNumber<std::int32_t>(record);
      if (in_double_)
        storeLasNumber(point + 8 * axis, value);
      else
        storeLasNumber(point + 4 * axis, static_cast<float>(value));
    }
    storeLasNumber(point + (in_double_ ? 24 : 12),
                   static_cast<float>(lasNumber<std::uint16_t>(record)));
  }

  /** Keeps 16 bits of each colour until the number of significant bits is known. */
  void
  storeColours(const std::uint8_t* colours, std::uint8_t* point)
  {
    const LazColour colour = lazColourOf(colours);
    for (const std::uint16_t value : colour)
      brightest_ = std::max(brightest_, value);
    colours_.push_back(colour);
    storeLasNumber(point + rgb_, std::uint32_t{0});
  }

  /** Most writers use 16 bits, some only 8. */
  void
  packColours()
  {
    const unsigned shift = brightest_ > 255 ? 8 : 0;
    for (std::size_t i = 0; i < colours_.size(); ++i) {
      const LazColour& colour = colours_[i];
      const std::uint32_t rgb = std::uint32_t{colour[0]} >> shift << 16 |
                                std::uint32_t{colour[1]} >> shift << 8 |
                                std::uint32_t{colour[2]} >> shift;
      storeLasNumber(&scan_.cloud.data[i * scan_.cloud.point_step + rgb_], rgb);
    }
    colours_ = {};
  }

  void
  storeOld(const std::uint8_t* record, std::uint8_t* point) const
  {
    storeLasNumber(point + rest_,
                   static_cast<float>(static_cast<std::int8_t>(record[16])));
    std::memcpy(point + rest_ + 4, record + 18, 2);
    point[bytes_] = record[14] & 7;
    point[bytes_ + 1] = record[14] >> 3 & 7;
    point[bytes_ + 2] = header_.minor > 0 ? record[15] & 31 : record[15];
    point[bytes_ + 3] = record[17];
  }

  void
  storeNew(const std::uint8_t* record, std::uint8_t* point) const
  {
    storeLasNumber(point + rest_,
                   kDegreesPerAngle * lasNumber<std::int16_t>(record + 18));
    std::memcpy(point + rest_ + 4, record + 20, 2);
    point[bytes_] = record[14] & 15;
    point[bytes_ + 1] = record[14] >> 4;
    point[bytes_ + 2] = record[16];
    point[bytes_ + 3] = record[17];
  }

  const LasHeader& header_;
  bool in_double_;
  ScanCloud scan_;
  std::size_t rgb_ = 0, time_ = 0, infrared_ = 0; ///< where the fields begin
  std::size_t rest_ = 0;                          ///< scan_angle, point_source_id
  std::size_t bytes_ = 0;                         ///< the one-byte fields
  std::vector<LazColour> colours_;
  std::uint16_t brightest_ = 0;
  std::size_t num_deleted_ = 0;
};

bool
isFarPoint(const LasHeader& header, const std::uint8_t* record)
{
  Eigen::Vector3d place;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    place[axis] = header.offset[axis] +
                  header.scale[axis] * lasNumber<std::int32_t>(record + 4 * axis);
  return place.norm() > kNear;
}

[[noreturn]] void
failTruncated(const FileInput& input, const LasHeader& header, std::size_t found)
{
  text::fail(input.path(),
             "is truncated: it holds " + std::to_string(found) + " of " +
                 text::counted(header.count, "point"));
}

/** Reads uncompressed points block by block. */
ScanCloud
readRecords(FileInput& input, const LasHeader& header, bool in_double)
{
  const std::size_t size = header.record_size;
  const auto ahead = input.sizeAhead();
  if (ahead && *ahead / size < header.count)
    failTruncated(input, header, *ahead / size);
  std::vector<std::uint8_t> records;
  std::optional<LasPoints> points;
  for (std::uint64_t done = 0; done < header.count;) {
    const std::size_t wanted =
        static_cast<std::size_t>(std::min<std::uint64_t>(kAtOnce, header.count - done));
    records.clear();
    if (!input.append(wanted * size, records))
      failTruncated(input, header, done + records.size() / size);
    if (!points) {
      points.emplace(header, in_double || isFarPoint(header, records.data()));
      points->reserve(ahead ? header.count : 0);
    }
    for (std::size_t i = 0; i < wanted; ++i)
      points->add(&records[i * size]);
    done += wanted;
  }
  return points ? points->finish() : LasPoints(header, in_double).finish();
}

ScanCloud
readCompressed(FileInput& input, const LasHeader& header, bool in_double)
{
  std::vector<std::uint8_t> data;
  input.appendRest(data);
  LazReader reader(input.path(), header, data);
  std::vector<std::uint8_t> record(header.record_size);
  std::optional<LasPoints> points;
  for (std::uint64_t i = 0; i < header.count; ++i) {
    reader.next(record.data());
    if (!points)
      points.emplace(header, in_double || isFarPoint(header, record.data()));
    points->add(record.data());
  }
  return points ? points->finish() : LasPoints(header, in_double).finish();
}

ScanCloud
readOnce(const std::filesystem::path& path, bool in_double)
{
  FileInput input(path);
  const LasHeader header = readLasHeader(input);
  return header.laz ? readCompressed(input, header, in_double)
                    : readRecords(input, header, in_double);
}

} // namespace

ScanCloud
readLas(const std::filesystem::path& path)
{
  ScanCloud scan = readOnce(path, false);
  if (needsDouble(path, scan.cloud))
    scan = readOnce(path, true);
  return scan;
}

} // namespace pcl6d::io

std::string
pcl6d::coordinateSystemOfLas(const std::filesystem::path& path)
{
  io::FileInput input(path);
  return io::readLasHeader(input).coordinate_system;
}
