// SPDX-License-Identifier: BSD-3-Clause
// Clouds with fields known only at run time: each field is read, averaged and written by its
// own type.
#include <pcl6d/common/require.h>
#include <pcl6d/common/require_indices.h>
#include <pcl6d/filters/pcl/octree_reduction.h>

#include <pcl/PCLPointCloud2.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace pcl6d {

namespace {
using Blob = pcl::PCLPointCloud2;
using Field = pcl::PCLPointField;

std::size_t
sizeOf(const Field& field)
{
  switch (field.datatype) {
  case Field::INT8:
  case Field::UINT8:
    return 1;
  case Field::INT16:
  case Field::UINT16:
    return 2;
  case Field::FLOAT64:
    return 8;
  default:
    return 4;
  }
}

template <typename Number>
double
readAs(const std::uint8_t* data)
{
  Number number;
  std::memcpy(&number, data, sizeof(number));
  return static_cast<double>(number);
}

double
read(const Field& field, const std::uint8_t* data)
{
  switch (field.datatype) {
  case Field::INT8:
    return readAs<std::int8_t>(data);
  case Field::UINT8:
    return readAs<std::uint8_t>(data);
  case Field::INT16:
    return readAs<std::int16_t>(data);
  case Field::UINT16:
    return readAs<std::uint16_t>(data);
  case Field::INT32:
    return readAs<std::int32_t>(data);
  case Field::UINT32:
    return readAs<std::uint32_t>(data);
  case Field::FLOAT64:
    return readAs<double>(data);
  default:
    return readAs<float>(data);
  }
}

template <typename Number>
void
writeAs(double value, std::uint8_t* data)
{
  if (std::numeric_limits<Number>::is_integer)
    value = std::round(value);
  const auto number = static_cast<Number>(value); // a mean of values of this type: fits
  std::memcpy(data, &number, sizeof(number));
}

void
write(const Field& field, double value, std::uint8_t* data)
{
  switch (field.datatype) {
  case Field::INT8:
    return writeAs<std::int8_t>(value, data);
  case Field::UINT8:
    return writeAs<std::uint8_t>(value, data);
  case Field::INT16:
    return writeAs<std::int16_t>(value, data);
  case Field::UINT16:
    return writeAs<std::uint16_t>(value, data);
  case Field::INT32:
    return writeAs<std::int32_t>(value, data);
  case Field::UINT32:
    return writeAs<std::uint32_t>(value, data);
  case Field::FLOAT64:
    return writeAs<double>(value, data);
  default:
    return writeAs<float>(value, data);
  }
}

bool
isColour(const Field& field)
{
  return field.name == "rgb" || field.name == "rgba";
}

/** \return the field; must exist, and lie within the points */
const Field&
fieldOf(const Blob& cloud, const std::string& name)
{
  const auto found = std::find_if(cloud.fields.begin(),
                                  cloud.fields.end(),
                                  [&](const Field& f) { return f.name == name; });
  require(found != cloud.fields.end(), "field", name, "one of the cloud");
  return *found;
}

void
requireWhole(const Blob& cloud)
{
  const std::size_t count = std::size_t{cloud.width} * cloud.height;
  require(cloud.data.size() >= count * cloud.point_step,
          "bytes of the cloud",
          cloud.data.size(),
          "width * height * point_step");
  for (const auto& field : cloud.fields)
    require(field.offset + sizeOf(field) * std::max(1u, field.count) <=
                cloud.point_step,
            ("offset of the field " + field.name).c_str(),
            field.offset,
            "smaller: the field must lie within a point");
}

/** Averages the numbers of a field over the members of a voxel. */
void
average(const Blob& cloud,
        const Field& field,
        const IndexRange& members,
        const pcl::Indices& chosen,
        std::uint8_t* out)
{
  const bool by_byte = isColour(field);
  Field part = field;
  if (by_byte)
    part.datatype = Field::UINT8;
  const std::size_t size = sizeOf(part);
  const std::size_t count = by_byte ? 4 : std::max(1u, field.count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t offset = field.offset + k * size;
    double sum = 0;
    for (const auto i : members)
      sum +=
          read(part, &cloud.data[chosen[i] * std::size_t{cloud.point_step} + offset]);
    write(part, sum / static_cast<double>(members.size()), out + offset);
  }
}
} // namespace

void
OctreeReduction<Blob>::applyFilter(Blob& output)
{
  options_.validate();
  if (!hasLeaf()) {
    OctreeReduction with_leaf = *this;
    const auto side = static_cast<float>(options_.voxel);
    with_leaf.setLeafSize(side, side, side);
    return with_leaf.applyFilter(output);
  }
  const Blob& input = *input_;
  const pcl::Indices& chosen = *indices_;
  requireWhole(input);
  requireIndices(chosen, std::size_t{input.width} * input.height);
  const Field* xyz[] = {
      &fieldOf(input, "x"), &fieldOf(input, "y"), &fieldOf(input, "z")};
  const Field* limited = field_.empty() ? nullptr : &fieldOf(input, field_);
  Points points(chosen.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::uint8_t* data = &input.data[chosen[i] * std::size_t{input.point_step}];
    for (int axis = 0; axis < 3; ++axis)
      points[i][axis] = static_cast<float>(read(*xyz[axis], data + xyz[axis]->offset));
    if (limited && !isWithinLimits(read(*limited, data + limited->offset)))
      points[i].setConstant(std::numeric_limits<float>::quiet_NaN());
  }
  const CoordinateView view = viewOf(points);
  findCells(view);
  const LeafGroups groups(LeafOrder(view, cells()));
  const std::vector<std::size_t> kept = keptGroups(groups, view);
  Blob reduced;
  reduced.header = input.header;
  reduced.is_bigendian = input.is_bigendian;
  reduced.is_dense = true;
  reduced.point_step = input.point_step;
  for (const auto& field : input.fields)
    if (downsample_all_ || &field == xyz[0] || &field == xyz[1] || &field == xyz[2])
      reduced.fields.push_back(field);
  reduced.height = 1;
  reduced.width = static_cast<std::uint32_t>(kept.size());
  reduced.row_step = reduced.width * reduced.point_step;
  reduced.data.assign(kept.size() * input.point_step, 0);
  for (std::size_t k = 0; k < kept.size(); ++k)
    for (const auto& field : reduced.fields)
      average(input,
              field,
              groups.indices(kept[k]),
              chosen,
              &reduced.data[k * input.point_step]);
  output = std::move(reduced);
}

} // namespace pcl6d
