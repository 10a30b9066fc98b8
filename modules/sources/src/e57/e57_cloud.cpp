// SPDX-License-Identifier: BSD-3-Clause
#include "e57/e57_cloud.h"
#include "e57/record_reader.h"

#include <pcl6d/io/text.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace pcl6d::sources {

namespace {

using pcl::PCLPointField;

/** \brief A field of the file that maps to a single field of the cloud. */
struct PlainField {
  const char* name; ///< in the file
  const char* becomes;
  std::uint8_t datatype;
  const char* invalid; ///< the file's field that is not 0 for invalid values
};
constexpr PlainField kPlainFields[] = {
    {"intensity", "intensity", PCLPointField::FLOAT32, "isIntensityInvalid"},
    {"normalX", "normal_x", PCLPointField::FLOAT32, nullptr},
    {"normalY", "normal_y", PCLPointField::FLOAT32, nullptr},
    {"normalZ", "normal_z", PCLPointField::FLOAT32, nullptr},
    {"timeStamp", "time", PCLPointField::FLOAT64, "isTimeStampInvalid"},
    {"rowIndex", "row", PCLPointField::INT32, nullptr},
    {"columnIndex", "column", PCLPointField::INT32, nullptr},
    {"returnIndex", "return_index", PCLPointField::INT32, nullptr},
    {"returnCount", "return_count", PCLPointField::INT32, nullptr}};

/** \brief A value of the points in the file. */
struct Column {
  std::size_t number = 0; ///< index in the list of fields to read
  E57Field field;
};

/** \brief Puts the points of a scan into a cloud. */
class CloudFilling {
public:
  CloudFilling(const PageReader& file,
               const E57Scan& scan,
               const std::string& title,
               Coordinates coordinates)
  : scan_(scan)
  {
    scan_cloud_.cloud.is_bigendian = false;
    addCoordinates(file, title, coordinates);
    for (const auto& plain : kPlainFields)
      if (const auto source = want(plain.name)) {
        const auto invalid =
            plain.invalid ? want(plain.invalid) : std::optional<Column>();
        plain_.push_back({*source,
                          invalid,
                          addField(plain.becomes, plain.datatype),
                          plain.datatype});
      }
    addColours();
    for (std::size_t i = 0; i < scan.fields.size(); ++i)
      if (std::find(wanted_.begin(), wanted_.end(), i) == wanted_.end())
        scan_cloud_.left_out.push_back("field " + text::quoted(scan.fields[i].name));
  }

  const std::vector<std::size_t>&
  wanted() const
  {
    return wanted_;
  }

  void
  add(const std::vector<const E57Column*>& columns, std::size_t count)
  {
    auto& data = scan_cloud_.cloud.data;
    const std::size_t before = data.size();
    const std::size_t step = scan_cloud_.cloud.point_step;
    if (before == 0) // readRecords() has checked the number against the file size
      data.reserve(scan_.count * step);
    data.resize(before + count * step);
    std::uint8_t* const points = data.data() + before;
    values_.resize(columns.size());
    for (std::size_t c = 0; c < columns.size(); ++c)
      columns[c]->copyValues(scan_.fields[wanted_[c]], count, values_[c]);
    fillCoordinates(count, points);
    for (const Plain& plain : plain_)
      fillPlain(plain, count, points);
    if (!colours_.empty())
      fillColours(count, points);
  }

  ScanCloud
  finish()
  {
    pcl::PCLPointCloud2& cloud = scan_cloud_.cloud;
    cloud.width = static_cast<pcl::uindex_t>(cloud.data.size() / cloud.point_step);
    cloud.height = 1;
    cloud.row_step = static_cast<pcl::uindex_t>(cloud.data.size());
    cloud.is_dense = false;
    return std::move(scan_cloud_);
  }

private:
  struct Plain {
    Column source;
    std::optional<Column> invalid;
    std::size_t offset = 0;
    std::uint8_t datatype = 0;
  };

  std::optional<Column>
  want(const std::string& name)
  {
    const auto field = scan_.find(name);
    if (!field || scan_.fields[*field].kind == E57Kind::kString)
      return {};
    wanted_.push_back(*field);
    return Column{wanted_.size() - 1, scan_.fields[*field]};
  }

  bool
  has(const std::string& name) const
  {
    return scan_.find(name).has_value();
  }

  std::size_t
  addField(const std::string& name, std::uint8_t datatype)
  {
    pcl::PCLPointCloud2& cloud = scan_cloud_.cloud;
    PCLPointField field;
    field.name = name;
    field.offset = cloud.point_step;
    field.datatype = datatype;
    field.count = 1;
    cloud.fields.push_back(field);
    cloud.point_step += datatype == PCLPointField::FLOAT64 ? 8 : 4;
    return field.offset;
  }

  void
  addCoordinates(const PageReader& file,
                 const std::string& title,
                 Coordinates coordinates)
  {
    is_spherical_ = !(has("cartesianX") && has("cartesianY") && has("cartesianZ"));
    const std::vector<std::string> names =
        is_spherical_
            ? std::vector<std::string>{"sphericalRange",
                                       "sphericalAzimuth",
                                       "sphericalElevation"}
            : std::vector<std::string>{"cartesianX", "cartesianY", "cartesianZ"};
    for (const auto& name : names)
      if (const auto column = want(name))
        place_.push_back(*column);
    if (place_.size() < 3)
      text::fail(file.path(),
                 title + ": the points have no cartesianX, cartesianY, cartesianZ and "
                         "no sphericalRange, sphericalAzimuth, sphericalElevation");
    state_ = want(is_spherical_ ? "sphericalInvalidState" : "cartesianInvalidState");
    is_double_ = coordinates == Coordinates::kDouble;
    for (const char* const axis : {"x", "y", "z"})
      addField(axis, is_double_ ? PCLPointField::FLOAT64 : PCLPointField::FLOAT32);
  }

  void
  addColours()
  {
    if (!has("colorRed") || !has("colorGreen") || !has("colorBlue"))
      return;
    for (const char* const name : {"colorRed", "colorGreen", "colorBlue"})
      if (const auto column = want(name))
        colours_.push_back(*column);
    if (colours_.size() < 3)
      return colours_.clear();
    for (std::size_t i = 0; i < 3; ++i)
      ranges_.push_back(colourRange(scan_.colour[i], colours_[i].field));
    colour_invalid_ = want("isColorInvalid");
    colour_offset_ = addField("rgb", PCLPointField::FLOAT32);
  }

  /** \return the values of black and of full intensity */
  static std::pair<double, double>
  colourRange(const E57Limits& limits, const E57Field& field)
  {
    if (limits && limits->second > limits->first)
      return *limits;
    if (!field.isInteger())
      return {0, 1};
    const double low = field.valueOf(field.minimum),
                 high = field.valueOf(field.maximum);
    return high > low ? std::pair(low, high) : std::pair(0.0, 255.0);
  }

  bool
  isInvalid(const std::optional<Column>& state, std::size_t i) const
  {
    return state && values_[state->number][i] != 0;
  }

  Eigen::Vector3d
  placeAt(std::size_t i) const
  {
    Eigen::Vector3d p(values_[place_[0].number][i],
                      values_[place_[1].number][i],
                      values_[place_[2].number][i]);
    if (is_spherical_) { // range, azimuth from x to y, elevation above the plane of both
      const double flat = p[0] * std::cos(p[2]);
      p = {flat * std::cos(p[1]), flat * std::sin(p[1]), p[0] * std::sin(p[2])};
    }
    if (p.isZero(0) || isInvalid(state_, i))
      p.setConstant(std::numeric_limits<double>::quiet_NaN());
    return p;
  }

  void
  fillCoordinates(std::size_t count, std::uint8_t* point) const
  {
    for (std::size_t i = 0; i < count; ++i, point += scan_cloud_.cloud.point_step) {
      const Eigen::Vector3d p = placeAt(i);
      const Eigen::Vector3f rounded = p.cast<float>();
      if (is_double_)
        std::memcpy(point, p.data(), sizeof(double) * 3);
      else
        std::memcpy(point, rounded.data(), sizeof(float) * 3);
    }
  }

  void
  fillPlain(const Plain& plain, std::size_t count, std::uint8_t* point) const
  {
    const std::vector<double>& values = values_[plain.source.number];
    point += plain.offset;
    for (std::size_t i = 0; i < count; ++i, point += scan_cloud_.cloud.point_step) {
      const double value = isInvalid(plain.invalid, i) ? 0 : values[i];
      const auto single = static_cast<float>(value);
      const auto integer = static_cast<std::int32_t>(
          std::isfinite(value) ? std::clamp(value, -2147483648.0, 2147483647.0) : 0);
      if (plain.datatype == PCLPointField::FLOAT64)
        std::memcpy(point, &value, sizeof value);
      else if (plain.datatype == PCLPointField::FLOAT32)
        std::memcpy(point, &single, sizeof single);
      else
        std::memcpy(point, &integer, sizeof integer);
    }
  }

  /** Packed in PCL's order: blue, green, red in memory. */
  void
  fillColours(std::size_t count, std::uint8_t* point) const
  {
    point += colour_offset_;
    for (std::size_t i = 0; i < count; ++i, point += scan_cloud_.cloud.point_step) {
      std::uint8_t bytes[4] = {};
      for (std::size_t c = 0; c < 3; ++c) {
        const auto [dark, light] = ranges_[c];
        const double value =
            (values_[colours_[c].number][i] - dark) / (light - dark) * 255;
        if (value > 0 && !isInvalid(colour_invalid_, i)) // false for NaN
          bytes[2 - c] = static_cast<std::uint8_t>(std::min(std::round(value), 255.0));
      }
      std::memcpy(point, bytes, sizeof bytes);
    }
  }

  const E57Scan& scan_;
  ScanCloud scan_cloud_;
  std::vector<std::vector<double>> values_; ///< of the points on their way, by field
  std::vector<std::size_t> wanted_;
  bool is_spherical_ = false;
  bool is_double_ = false;
  std::vector<Column> place_;
  std::optional<Column> state_;
  std::vector<Plain> plain_;
  std::vector<Column> colours_; ///< red, green, blue; or empty
  std::vector<std::pair<double, double>> ranges_;
  std::optional<Column> colour_invalid_;
  std::size_t colour_offset_ = 0;
};

} // namespace

ScanCloud
readE57Cloud(PageReader& file,
             const E57Scan& scan,
             const std::string& title,
             Coordinates coordinates)
{
  constexpr auto kMost = std::numeric_limits<pcl::uindex_t>::max();
  if (scan.count > kMost)
    text::fail(file.path(),
               title + ": has " + text::counted(scan.count, "point") +
                   ", but a cloud holds at most " + std::to_string(kMost));
  CloudFilling filling(file, scan, title, coordinates);
  readRecords(
      file, scan, title, filling.wanted(), [&](const auto& columns, std::size_t count) {
        filling.add(columns, count);
      });
  ScanCloud cloud = filling.finish();
  arrangeInRows(scan.lines_are_columns, cloud.cloud);
  return cloud;
}

} // namespace pcl6d::sources
