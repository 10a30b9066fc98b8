// SPDX-License-Identifier: BSD-3-Clause
#include "scan/pcd/pcd_header.h"
#include "scan/point_field.h"
#include "scan/scan_formats.h"
#include "text/file_input.h"
#include "text/text_row.h"

#include <pcl6d/common/number_range.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_writer.h>

#include <pcl/io/lzf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace pcl6d {

using namespace io;

namespace {

using Bytes = std::vector<std::uint8_t>;
using pcl::PCLPointField;

constexpr std::size_t kSizes = 2 * sizeof(std::uint32_t); // ahead of compressed data
constexpr std::size_t kMaxExpansion = 100; // LZF: 264 bytes from 3, a factor of 88

std::size_t
sizeOf(const PCLPointField& field)
{
  return field.count * sizeOfType(field.datatype);
}

/** \brief Reads a whole number in a form such as 12.0 or 4.29e9. \return false if not a whole
 * number, or outside the type's range */
template <typename T>
bool
parseWhole(std::string_view token, T& value)
{
  double number = 0;
  if constexpr (std::is_integral_v<T>)
    if (text::parseNumber(token, number) && number == std::floor(number)) {
      value = clampedTo<T>(number);
      return static_cast<double>(value) == number;
    }
  return false;
}

/** Stores the values of a field from the tokens of a line in a point. */
void
parseField(const std::filesystem::path& path,
           std::size_t line,
           const PCLPointField& field,
           text::Tokens& tokens,
           std::uint8_t* point)
{
  withTypeOf(field.datatype, [&](auto value) {
    for (std::size_t i = 0; i < field.count; ++i) {
      const auto token = tokens.next();
      if (!text::parseNumber(token, value) && !parseWhole(token, value))
        text::failAt(path,
                     line,
                     text::quoted(token) + " is not a number" +
                         (std::is_integral_v<decltype(value)>
                              ? " that field '" + field.name + "' can hold"
                              : ""));
      std::memcpy(point + field.offset + i * sizeof value, &value, sizeof value);
    }
  });
}

std::size_t
countTokens(text::Tokens tokens)
{
  std::size_t count = 0;
  while (!tokens.next().empty())
    ++count;
  return count;
}

/** Parses a row again, slowly, after io::takeRow() failed. */
void
parseRow(const FileInput& input,
         const PcdHeader& header,
         std::size_t columns,
         std::uint8_t* point)
{
  const std::size_t count = countTokens(text::Tokens(input.line()));
  if (count != columns)
    text::failAt(input.path(),
                 input.number(),
                 "expected " + text::counted(columns, "number") + ", got " +
                     std::to_string(count));
  text::Tokens tokens(input.line());
  for (const auto& field : header.fields)
    parseField(input.path(), input.number(), field, tokens, point);
}

Bytes
decodeAscii(FileInput& input, const PcdHeader& header)
{
  const std::vector<Column> columns = columnsOf(header.fields); // padding, too
  const std::string expected = "expected " + text::counted(header.numPoints(), "point");
  Bytes data;
  // A number takes at least two characters, and at most eight bytes.
  data.reserve(std::min(header.numPoints() * header.point_size,
                        4 * input.sizeAhead().value_or(0)));
  std::size_t points = 0;
  while (input.next()) {
    if (text::isBlank(input.line()))
      continue;
    if (points == header.numPoints())
      text::failAt(input.path(), input.number(), expected + ", got more");
    data.resize(data.size() + header.point_size);
    std::uint8_t* const point = &data[points * header.point_size];
    if (!io::takeRow(input.line(), columns, point))
      parseRow(input, header, columns.size(), point);
    ++points;
  }
  if (points != header.numPoints())
    text::fail(input.path(), expected + ", got " + std::to_string(points));
  return data;
}

Bytes
decodeBinary(FileInput& input, const PcdHeader& header)
{
  Bytes data;
  if (!input.append(header.numPoints() * header.point_size, data))
    text::fail(input.path(),
               "expected " + text::counted(header.numPoints(), "point") + " of " +
                   text::counted(header.point_size, "byte") + ", got " +
                   text::counted(data.size(), "byte"));
  return data;
}

/** \return the values of a compressed body, field by field \param[in] size [byte] */
Bytes
decompress(FileInput& input, std::size_t size)
{
  std::uint32_t sizes[2] = {}; // compressed, uncompressed
  if (input.read(reinterpret_cast<std::uint8_t*>(sizes), kSizes) < kSizes)
    text::fail(input.path(), "the sizes ahead of the compressed points are missing");
  if (sizes[1] != size)
    text::fail(input.path(),
               "expected " + text::counted(size, "byte") +
                   " of points before compression, got " + std::to_string(sizes[1]));
  Bytes compressed;
  if (!input.append(sizes[0], compressed))
    text::fail(input.path(),
               "expected " + text::counted(sizes[0], "byte") +
                   " of compressed points, got " + std::to_string(compressed.size()));
  Bytes values;
  if (size / kMaxExpansion <= sizes[0]) // otherwise memory is not allocated
    values.resize(size);
  std::size_t unpacked = 0;
  if (values.size() == size && sizes[0] > 0) // PCL reads a byte in any case
    unpacked = pcl::lzfDecompress(compressed.data(), sizes[0], values.data(), sizes[1]);
  if (values.size() != size || unpacked != size)
    text::fail(input.path(), "the compressed points are corrupt");
  return values;
}

Bytes
decodeCompressed(FileInput& input, const PcdHeader& header)
{
  std::size_t packed_size = 0; // padding is not stored
  for (const auto& field : header.fields)
    packed_size += isPadding(field) ? 0 : sizeOf(field);
  const std::size_t points = header.numPoints();
  const Bytes values = decompress(input, points * packed_size);
  Bytes data(points * header.point_size);
  const std::uint8_t* value = values.data();
  for (const auto& field : header.fields) {
    if (isPadding(field))
      continue;
    const std::size_t size = sizeOf(field);
    copyValues(
        value, size, data.data() + field.offset, header.point_size, size, points);
    value += points * size;
  }
  return data;
}

/** \return whether the floating-point values of the points [begin, end) are finite */
bool
isFinite(const pcl::PCLPointCloud2& cloud,
         const PCLPointField& field,
         std::size_t begin,
         std::size_t end)
{
  return withTypeOf(field.datatype, [&](auto value) {
    if constexpr (std::is_floating_point_v<decltype(value)>)
      for (std::size_t i = begin; i < end; ++i)
        for (std::size_t k = 0; k < field.count; ++k) {
          std::memcpy(
              &value,
              &cloud.data[i * cloud.point_step + field.offset + k * sizeof value],
              sizeof value);
          if (!std::isfinite(value))
            return false;
        }
    return true;
  });
}

/** \return whether all floating-point values are finite: PCL's definition of dense */
bool
isDense(const pcl::PCLPointCloud2& cloud)
{
  constexpr std::size_t kBlock = 1024; // points that fit into the cache
  const std::size_t points = std::size_t{cloud.width} * cloud.height;
  for (std::size_t begin = 0; begin < points; begin += kBlock)
    for (const auto& field : cloud.fields)
      if (!isFinite(cloud, field, begin, std::min(points, begin + kBlock)))
        return false;
  return true;
}

/** Changes x, y and z from float32 in the header to double. */
void
widenCoordinates(PcdHeader& header)
{
  const auto isNarrow = [](const PCLPointField& field) {
    return (field.name == "x" || field.name == "y" || field.name == "z") &&
           field.datatype == PCLPointField::FLOAT32 && field.count == 1;
  };
  constexpr pcl::uindex_t kMore = sizeof(double) - sizeof(float);
  const std::vector<PCLPointField> declared = header.fields;
  for (std::size_t i = 0; i < declared.size(); ++i)
    for (const PCLPointField& other : declared)
      if (isNarrow(other) && other.offset < declared[i].offset)
        header.fields[i].offset += kMore;
  for (PCLPointField& field : header.fields)
    if (isNarrow(field)) {
      field.datatype = PCLPointField::FLOAT64;
      header.point_size += kMore;
    }
}

/** \param[in] input stands behind the header
 * \return the points, laid out as in the header; padding is no longer a field
 * \throws IoFailed naming position, value and rule: too short, text in place of a number,
 * broken compression */
pcl::PCLPointCloud2
decodeBody(FileInput& input, const PcdHeader& header)
{
  pcl::PCLPointCloud2 cloud;
  if (header.encoding == PcdEncoding::kAscii)
    cloud.data = decodeAscii(input, header);
  else if (header.numPoints() > 0)
    cloud.data = header.encoding == PcdEncoding::kBinary
                     ? decodeBinary(input, header)
                     : decodeCompressed(input, header);
  cloud.width = static_cast<pcl::uindex_t>(header.width);
  cloud.height = static_cast<pcl::uindex_t>(header.height);
  cloud.point_step = static_cast<pcl::uindex_t>(header.point_size);
  cloud.row_step = cloud.width * cloud.point_step;
  std::copy_if(header.fields.begin(),
               header.fields.end(),
               std::back_inserter(cloud.fields),
               [](const auto& field) { return !isPadding(field); });
  cloud.is_dense = isDense(cloud);
  return cloud;
}
} // namespace

void
writePcd(const std::filesystem::path& path,
         const pcl::PCLPointCloud2& cloud,
         const Eigen::Isometry3d& T_world_scan,
         PcdEncoding encoding)
{
  writeScan(path, cloud, T_world_scan, {ScanFormat::kPcd, encoding});
}

Eigen::Isometry3d
readPcdViewpoint(const std::filesystem::path& path)
{
  std::ifstream stream = text::open(path);
  return readPcdHeader(stream, path).viewpoint;
}

namespace {
pcl::PCLPointCloud2
readPcd(const std::filesystem::path& path, Digits digits)
{
  std::ifstream stream = text::open(path);
  PcdHeader header = readPcdHeader(stream, path);
  FileInput input(std::move(stream), path, header.num_lines);
  if (digits == Digits::kDouble)
    widenCoordinates(header);
  pcl::PCLPointCloud2 cloud = decodeBody(input, header);
  return digits == Digits::kFloat && header.encoding == PcdEncoding::kAscii &&
                 needsDouble(path, cloud)
             ? readPcd(path, Digits::kDouble)
             : cloud;
}
} // namespace

pcl::PCLPointCloud2
readPcd(const std::filesystem::path& path)
{
  return readPcd(path, Digits::kFloat);
}

} // namespace pcl6d
