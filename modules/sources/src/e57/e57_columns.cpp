// SPDX-License-Identifier: BSD-3-Clause
#include "e57/e57_columns.h"

#include <pcl6d/common/require.h>
#include <pcl6d/io/text.h>
#include <pcl6d/io/vector_field.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <set>

namespace pcl6d::sources {

namespace {

using pcl::PCLPointField;

/** Fields written with unchanged numbers. */
constexpr std::array<std::array<const char*, 2>, 9> kKept = {
    {{"intensity", "intensity"},
     {"normal_x", "nor:normalX"},
     {"normal_y", "nor:normalY"},
     {"normal_z", "nor:normalZ"},
     {"time", "timeStamp"},
     {"row", "rowIndex"},
     {"column", "columnIndex"},
     {"return_index", "returnIndex"},
     {"return_count", "returnCount"}}};

const PCLPointField*
fieldOfCloud(const pcl::PCLPointCloud2& cloud, const std::string& name)
{
  for (const auto& field : cloud.fields)
    if (field.name == name)
      return &field;
  return nullptr;
}

bool
isPaddingField(const PCLPointField& field)
{
  return field.name == "_" || field.count == 0;
}

E57Field
realField(const char* name, std::uint8_t datatype)
{
  E57Field field;
  field.name = name;
  field.kind = datatype == PCLPointField::FLOAT64 ? E57Kind::kDouble : E57Kind::kSingle;
  return field;
}

E57Field
integerField(const char* name, std::int64_t minimum, std::int64_t maximum)
{
  E57Field field;
  field.name = name;
  field.kind = E57Kind::kInteger;
  field.minimum = minimum;
  field.maximum = maximum;
  return field;
}

using ValueAt = std::function<double(std::size_t)>;

template <typename T>
ValueAt
numberAt(const pcl::PCLPointCloud2& cloud, std::size_t offset)
{
  return [&cloud, offset](std::size_t i) {
    T value;
    std::memcpy(&value, &cloud.data[i * cloud.point_step + offset], sizeof value);
    return static_cast<double>(value);
  };
}

/** \return the values of a field; empty for 64-bit integers, which exceed double */
ValueAt
valuesOfField(const pcl::PCLPointCloud2& cloud, const PCLPointField& field)
{
  switch (field.datatype) {
  case PCLPointField::INT8:
    return numberAt<std::int8_t>(cloud, field.offset);
  case PCLPointField::UINT8:
    return numberAt<std::uint8_t>(cloud, field.offset);
  case PCLPointField::INT16:
    return numberAt<std::int16_t>(cloud, field.offset);
  case PCLPointField::UINT16:
    return numberAt<std::uint16_t>(cloud, field.offset);
  case PCLPointField::INT32:
    return numberAt<std::int32_t>(cloud, field.offset);
  case PCLPointField::UINT32:
    return numberAt<std::uint32_t>(cloud, field.offset);
  case PCLPointField::FLOAT32:
    return numberAt<float>(cloud, field.offset);
  case PCLPointField::FLOAT64:
    return numberAt<double>(cloud, field.offset);
  default:
    return {};
  }
}

/** \return the least and the largest finite value; empty without finite values */
E57Limits
limitsOfValues(const ValueAt& at, std::size_t count)
{
  E57Limits limits;
  for (std::size_t i = 0; i < count; ++i) {
    const double value = at(i);
    if (std::isfinite(value))
      limits = limits ? std::pair(std::min(limits->first, value),
                                  std::max(limits->second, value))
                      : std::pair(value, value);
  }
  return limits;
}

std::pair<std::int64_t, std::int64_t>
rangeOfIntegers(const E57Limits& limits)
{
  return limits ? std::pair(static_cast<std::int64_t>(limits->first),
                            static_cast<std::int64_t>(limits->second))
                : std::pair<std::int64_t, std::int64_t>();
}

/** \brief Collects the columns of a station. */
class ColumnList {
public:
  ColumnList(const E57Station& station, WrittenScan& written)
  : station_(station)
  , cloud_(station.scan.cloud)
  , count_(std::size_t{cloud_.width} * cloud_.height)
  , written_(written)
  {
    addPlaces();
    for (const auto& [name, becomes] : kKept)
      addKept(name, becomes);
    addGrid();
    addColours();
    for (const auto& field : cloud_.fields)
      if (!isPaddingField(field) && known_.insert(field.name).second)
        written_.losses.push_back("dropped field " + text::quoted(field.name));
  }

  std::vector<ValueColumn>
  take()
  {
    return std::move(columns_);
  }

private:
  void
  add(E57Field field, ValueAt at)
  {
    columns_.push_back({std::move(field), std::move(at)});
  }

  void
  addPlaces()
  {
    const VectorField place(cloud_.fields, {"x", "y", "z"});
    require(static_cast<bool>(place), "fields", "others", "x, y, z of floating point");
    const auto isValid = [place, &cloud = cloud_](std::size_t i) {
      return place.read(&cloud.data[i * cloud.point_step]).allFinite();
    };
    bool is_first = true, has_invalid = false;
    for (std::size_t i = 0; i < count_; ++i) {
      const Eigen::Vector3d p = place.read(&cloud_.data[i * cloud_.point_step]);
      if (!p.allFinite()) {
        has_invalid = true;
        continue;
      }
      written_.least = is_first ? p : written_.least.cwiseMin(p).eval();
      written_.most = is_first ? p : written_.most.cwiseMax(p).eval();
      is_first = false;
    }
    constexpr std::array<std::array<const char*, 2>, 3> kAxisNames = {
        {{"x", "cartesianX"}, {"y", "cartesianY"}, {"z", "cartesianZ"}}};
    for (const auto& [name, becomes] : kAxisNames) {
      known_.insert(name);
      const PCLPointField& field = *fieldOfCloud(cloud_, name);
      ValueAt at = valuesOfField(cloud_, field);
      if (has_invalid)
        at = [at, isValid](std::size_t i) { return isValid(i) ? at(i) : 0; };
      add(realField(becomes, field.datatype), at);
    }
    if (has_invalid)
      add(integerField("cartesianInvalidState", 0, 2),
          [isValid](std::size_t i) { return isValid(i) ? 0 : 2; });
  }

  void
  addKept(const char* name, const char* becomes)
  {
    const PCLPointField* const field = fieldOfCloud(cloud_, name);
    const bool is_single = field && field->count <= 1 && !isPaddingField(*field);
    const ValueAt at = is_single ? valuesOfField(cloud_, *field) : ValueAt();
    const bool is_real = field && (field->datatype == PCLPointField::FLOAT32 ||
                                   field->datatype == PCLPointField::FLOAT64);
    const bool needs_integer =
        std::strstr(becomes, "Index") || std::strstr(becomes, "Count");
    if (!at || (needs_integer && is_real))
      return;
    known_.insert(name);
    const bool is_intensity = !std::strcmp(becomes, "intensity");
    const E57Limits limits =
        is_intensity || !is_real ? limitsOfValues(at, count_) : E57Limits();
    const auto range =
        is_real ? std::pair<std::int64_t, std::int64_t>() : rangeOfIntegers(limits);
    if (is_intensity)
      written_.intensity = limits;
    if (!std::strcmp(becomes, "rowIndex"))
      written_.rows = range;
    if (!std::strcmp(becomes, "columnIndex"))
      written_.columns = range;
    add(is_real ? realField(becomes, field->datatype)
                : integerField(becomes, range.first, range.second),
        at);
  }

  /** Adds the cells of the rows, unless given by fields of the cloud. */
  void
  addGrid()
  {
    const std::size_t length =
        cloud_.height > 1 ? cloud_.width : station_.scan.row_length;
    const auto& places = station_.scan.places;
    if (length == 0 || written_.rows || written_.columns ||
        (!places.empty() && places.size() != count_))
      return;
    const auto cell = [&places](std::size_t i) {
      return places.empty() ? i : std::size_t{places[i]};
    };
    const ValueAt row = [=](std::size_t i) {
      const std::size_t number = cell(i) / length;
      return static_cast<double>(number);
    };
    const ValueAt column = [=](std::size_t i) {
      return static_cast<double>(cell(i) % length);
    };
    written_.rows = rangeOfIntegers(limitsOfValues(row, count_));
    written_.columns = rangeOfIntegers(limitsOfValues(column, count_));
    add(integerField("rowIndex", written_.rows->first, written_.rows->second), row);
    add(integerField("columnIndex", written_.columns->first, written_.columns->second),
        column);
  }

  /** Packed colours are blue, green, red, alpha in memory. */
  void
  addColours()
  {
    const PCLPointField* field = fieldOfCloud(cloud_, "rgb");
    if (!field)
      field = fieldOfCloud(cloud_, "rgba");
    const bool has_four_bytes = field && (field->datatype == PCLPointField::FLOAT32 ||
                                          field->datatype == PCLPointField::UINT32 ||
                                          field->datatype == PCLPointField::INT32);
    if (!has_four_bytes)
      return;
    known_.insert(field->name);
    if (field->name == "rgba")
      written_.losses.emplace_back("dropped the alpha of field 'rgba'");
    constexpr std::array<const char*, 3> kColours = {
        "colorRed", "colorGreen", "colorBlue"};
    for (std::size_t c = 0; c < 3; ++c)
      add(integerField(kColours[c], 0, 255),
          numberAt<std::uint8_t>(cloud_, field->offset + 2 - c));
  }

  const E57Station& station_;
  const pcl::PCLPointCloud2& cloud_;
  std::size_t count_;
  WrittenScan& written_;
  std::vector<ValueColumn> columns_;
  std::set<std::string> known_; ///< fields of the cloud without need of a loss message
};

std::size_t
sizeOfField(const PCLPointField& field)
{
  constexpr std::size_t kSizes[] = {1, 1, 1, 2, 2, 4, 4, 4, 8, 8, 8, 8}; // by datatype
  const std::size_t type = std::min<std::size_t>(field.datatype, std::size(kSizes) - 1);
  return kSizes[type] * std::max<std::size_t>(field.count, 1);
}

/** \throws BadArgument fields and data do not fit together */
void
requireWhole(const pcl::PCLPointCloud2& cloud)
{
  const std::size_t points = std::size_t{cloud.width} * cloud.height;
  require(cloud.data.size() == points * cloud.point_step,
          "bytes of the cloud",
          cloud.data.size(),
          "those of " + text::counted(points, "point") + " of " +
              text::counted(cloud.point_step, "byte"));
  for (const auto& field : cloud.fields)
    require(field.offset + sizeOfField(field) <= cloud.point_step,
            ("end of field " + field.name).c_str(),
            field.offset + sizeOfField(field),
            "within a point of " + std::to_string(cloud.point_step) + " bytes");
}

} // namespace

std::vector<ValueColumn>
columnsOf(const E57Station& station, WrittenScan& written)
{
  requireWhole(station.scan.cloud);
  return ColumnList(station, written).take();
}

} // namespace pcl6d::sources
