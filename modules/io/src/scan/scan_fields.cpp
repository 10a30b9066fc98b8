// SPDX-License-Identifier: BSD-3-Clause
#include "scan/point_field.h"

#include <pcl6d/common/number_range.h>
#include <pcl6d/common/require.h>
#include <pcl6d/io/scan_fields.h>

#include <algorithm>
#include <cstring>
#include <type_traits>
#include <utility>

namespace pcl6d {

using namespace io;

namespace {
/** \return the value in the type of a field; for an integer type the nearest representable
 * number */
template <typename T>
T
valueAs(double value)
{
  if constexpr (std::is_integral_v<T>)
    return clampedTo<T>(value);
  else
    return static_cast<T>(value);
}

std::size_t
sizeOf(const pcl::PCLPointCloud2& cloud)
{
  const std::size_t count = std::size_t{cloud.width} * cloud.height;
  const std::size_t bytes = count * cloud.point_step;
  require(cloud.data.size() >= bytes,
          "bytes of the cloud",
          cloud.data.size(),
          ">= " + std::to_string(bytes));
  return count;
}

const pcl::PCLPointField*
find(const pcl::PCLPointCloud2& cloud, const std::string& name)
{
  for (const auto& field : cloud.fields)
    if (field.name == name)
      return &field;
  return nullptr;
}

void
requireRoom(const pcl::PCLPointCloud2& cloud,
            const pcl::PCLPointField& field,
            std::size_t size)
{
  require(field.offset + size <= cloud.point_step,
          ("end of field " + field.name).c_str(),
          field.offset + size,
          "within a point of " + std::to_string(cloud.point_step) + " bytes");
}
} // namespace

std::optional<FieldValues>
fieldValues(const pcl::PCLPointCloud2& cloud, const std::string& name)
{
  const pcl::PCLPointField* const field = find(cloud, name);
  if (!field)
    return std::nullopt;
  FieldValues result;
  result.name = name;
  result.values.resize(sizeOf(cloud));
  withTypeOf(field->datatype, [&](auto value) {
    requireRoom(cloud, *field, sizeof value);
    result.is_integer = std::is_integral_v<decltype(value)>;
    for (std::size_t i = 0; i < result.values.size(); ++i) {
      std::memcpy(
          &value, &cloud.data[i * cloud.point_step + field->offset], sizeof value);
      result.values[i] = static_cast<double>(value);
    }
  });
  return result;
}

void
addField(pcl::PCLPointCloud2& cloud,
         const std::string& name,
         std::uint8_t datatype,
         const std::vector<double>& values)
{
  require(!find(cloud, name), "field", name, "not in the cloud yet");
  require(values.size() == sizeOf(cloud),
          "number of values",
          values.size(),
          "one per point, " + std::to_string(sizeOf(cloud)));
  pcl::PCLPointField field;
  field.name = name;
  field.offset = cloud.point_step;
  field.datatype = datatype;
  field.count = 1;
  withTypeOf(datatype, [&](auto value) {
    const std::size_t before = cloud.point_step;
    const std::size_t step = before + sizeof value;
    std::vector<std::uint8_t> data(values.size() * step);
    for (std::size_t i = 0; i < values.size(); ++i) {
      value = valueAs<decltype(value)>(values[i]);
      std::copy_n(cloud.data.data() + i * before, before, &data[i * step]); // or none
      std::memcpy(&data[i * step + before], &value, sizeof value);
    }
    cloud.data = std::move(data);
    cloud.point_step = static_cast<pcl::uindex_t>(step);
  });
  cloud.fields.push_back(field);
  cloud.row_step = cloud.width * cloud.point_step;
}

void
storeField(pcl::PCLPointCloud2& cloud,
           const std::string& name,
           std::uint8_t datatype,
           const std::vector<double>& values)
{
  const pcl::PCLPointField* const field = find(cloud, name);
  if (!field)
    return addField(cloud, name, datatype, values);
  require(values.size() == sizeOf(cloud),
          "number of values",
          values.size(),
          "one per point, " + std::to_string(sizeOf(cloud)));
  withTypeOf(field->datatype, [&](auto value) {
    requireRoom(cloud, *field, sizeof value);
    for (std::size_t i = 0; i < values.size(); ++i) {
      value = valueAs<decltype(value)>(values[i]);
      std::memcpy(
          &cloud.data[i * cloud.point_step + field->offset], &value, sizeof value);
    }
  });
}

void
keepPoints(pcl::PCLPointCloud2& cloud, const std::vector<bool>& keep)
{
  require(keep.size() == sizeOf(cloud),
          "number of points to keep or not",
          keep.size(),
          "one per point, " + std::to_string(sizeOf(cloud)));
  std::size_t kept = 0;
  const std::size_t step = cloud.point_step;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (!keep[i])
      continue;
    std::memmove(cloud.data.data() + kept * step, cloud.data.data() + i * step, step);
    ++kept;
  }
  cloud.data.resize(kept * step);
  cloud.width = static_cast<pcl::uindex_t>(kept);
  cloud.height = 1;
  cloud.row_step = static_cast<pcl::uindex_t>(kept * step);
}

namespace {
const pcl::PCLPointField&
coordinateField(const pcl::PCLPointCloud2& cloud, int axis)
{
  const std::string name(1, static_cast<char>('x' + axis));
  const pcl::PCLPointField* const field = find(cloud, name);
  require(field != nullptr, "field", name, "in the cloud");
  require(field->datatype == pcl::PCLPointField::FLOAT32 ||
              field->datatype == pcl::PCLPointField::FLOAT64,
          ("type of field " + name).c_str(),
          int{field->datatype},
          "float32 or float64");
  return *field;
}
} // namespace

Points
coordinatesOf(const pcl::PCLPointCloud2& cloud)
{
  Points points(sizeOf(cloud));
  for (int axis = 0; axis < 3; ++axis) {
    const pcl::PCLPointField& field = coordinateField(cloud, axis);
    withTypeOf(field.datatype, [&](auto value) {
      requireRoom(cloud, field, sizeof value);
      for (std::size_t i = 0; i < points.size(); ++i) {
        std::memcpy(
            &value, &cloud.data[i * cloud.point_step + field.offset], sizeof value);
        points[i][axis] = static_cast<float>(value);
      }
    });
  }
  return points;
}

void
storeCoordinates(const Points& points, pcl::PCLPointCloud2& cloud)
{
  require(points.size() == sizeOf(cloud),
          "number of points",
          points.size(),
          "that of the cloud");
  for (int axis = 0; axis < 3; ++axis) {
    const pcl::PCLPointField& field = coordinateField(cloud, axis);
    withTypeOf(field.datatype, [&](auto value) {
      requireRoom(cloud, field, sizeof value);
      for (std::size_t i = 0; i < points.size(); ++i) {
        value = valueAs<decltype(value)>(static_cast<double>(points[i][axis]));
        std::memcpy(
            &cloud.data[i * cloud.point_step + field.offset], &value, sizeof value);
      }
    });
  }
}

} // namespace pcl6d
