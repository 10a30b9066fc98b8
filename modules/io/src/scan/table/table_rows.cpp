// SPDX-License-Identifier: BSD-3-Clause
#include "scan/table/table_rows.h"

#include <pcl6d/common/number_range.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace pcl6d::io {

namespace {
using Field = pcl::PCLPointField;

/** Appends a field to a cloud without points. */
void
addTableField(const char* name,
              std::uint8_t datatype,
              std::size_t size,
              pcl::PCLPointCloud2& cloud)
{
  Field field;
  field.name = name;
  field.offset = cloud.point_step;
  field.datatype = datatype;
  field.count = 1;
  cloud.fields.push_back(field);
  cloud.point_step += static_cast<pcl::uindex_t>(size);
}

/** Appends a value to the bytes of the points. */
template <typename Value>
std::uint8_t*
put(std::uint8_t* place, Value value)
{
  std::memcpy(place, &value, sizeof value);
  return place + sizeof value;
}

bool
isBlankOrTab(char c)
{
  return c == ' ' || c == '\t';
}
} // namespace

template <typename T>
TableRows<T>::TableRows(const TableLayout& layout, pcl::PCLPointCloud2& cloud)
: layout_(layout)
{
  const auto has = [&](TableValue value) {
    return std::find(layout.columns.begin(), layout.columns.end(), value) !=
           layout.columns.end();
  };
  const auto has3 = [&](TableValue a, TableValue b, TableValue c) {
    return has(a) && has(b) && has(c);
  };
  const std::uint8_t type = std::is_same_v<T, float> ? Field::FLOAT32 : Field::FLOAT64;
  for (const char* const axis : {"x", "y", "z"})
    addTableField(axis, type, sizeof(T), cloud);
  if ((has_intensity_ = has(TableValue::kIntensity)))
    addTableField("intensity", Field::FLOAT32, sizeof(float), cloud);
  if ((has_colours_ = has3(TableValue::kRed, TableValue::kGreen, TableValue::kBlue)))
    addTableField("rgb", Field::FLOAT32, sizeof(float), cloud);
  if ((has_normals_ =
           has3(TableValue::kNormalX, TableValue::kNormalY, TableValue::kNormalZ)))
    for (const char* const axis : {"normal_x", "normal_y", "normal_z"})
      addTableField(axis, Field::FLOAT32, sizeof(float), cloud);
  if ((has_ring_ = has(TableValue::kRing)))
    addTableField("ring", Field::UINT16, sizeof(std::uint16_t), cloud);
  if ((has_time_ = has(TableValue::kTime)))
    addTableField("time", Field::FLOAT64, sizeof(double), cloud);
  point_step_ = cloud.point_step;
}

template <typename T>
bool
TableRows<T>::separates(char c) const
{
  return isBlankOrTab(c) || (layout_.separator == 0 && (c == ',' || c == ';'));
}

template <typename T>
bool
TableRows<T>::endsCell(char c) const
{
  return separates(c) || c == layout_.separator;
}

/** Parses a row in plain form: a number for every column.
 * \return false, with the row undefined, if the row must be parsed cell by cell */
template <typename T>
bool
TableRows<T>::takePlain(std::string_view text)
{
  const char* place = text.data();
  const char* const end = place + text.size();
  const char strict = layout_.separator == ' ' ? '\0' : layout_.separator;
  if (strict == 0 && text.find(',') != std::string_view::npos &&
      text.find_first_of("; \t") != std::string_view::npos)
    return false; // possibly a decimal comma
  const auto skip = [&] {
    while (place != end && *place != strict && separates(*place))
      ++place;
  };
  for (std::size_t i = 0; i < layout_.columns.size(); ++i) {
    skip();
    const TableValue value = layout_.columns[i];
    if (value == TableValue::kNone)
      while (place != end && !endsCell(*place))
        ++place;
    else {
      auto& number = row_[static_cast<std::size_t>(value)];
      const auto result = value == TableValue::kTime
                              ? std::from_chars(place, end, time_)
                              : std::from_chars(place, end, number);
      if (result.ec != std::errc() || (result.ptr != end && !endsCell(*result.ptr)))
        return false;
      place = result.ptr;
    }
    skip();
    if (strict == 0)
      continue;
    const bool is_last = i + 1 == layout_.columns.size();
    if (place == end ? !is_last : *place != strict)
      return false;
    place += place == end || is_last ? 0 : 1;
  }
  return place == end || further_line_ > 0 || !layout_.left_out.empty();
}

/** \return the cells of a row, where commas may separate or be decimal */
template <typename T>
std::vector<std::string_view>
TableRows<T>::split(const TableLine& line)
{
  if (layout_.separator != 0 && layout_.separator != ' ')
    return cellsOf(line.text, layout_.separator);
  const bool has_other = line.text.find_first_of(";\t") != std::string_view::npos;
  if (const auto token = unclearDecimalComma(line.text); !token.empty())
    line.fail(text::quoted(token) + " has a decimal comma, but decimal commas need a "
                                    "semicolon or a tab between numbers");
  if (layout_.separator == ' ')
    return cellsOf(line.text, ' ');
  std::vector<std::string_view> cells;
  text::Tokens tokens(line.text, has_other ? ";" : ",");
  for (auto token = tokens.next(); !token.empty(); token = tokens.next()) {
    if (token.back() == ',')
      token.remove_suffix(1);
    if (std::count(token.begin(), token.end(), ',') < 2) {
      if (!token.empty())
        cells.push_back(token);
      continue;
    }
    text::Tokens parts(token, ",");
    for (auto part = parts.next(); !part.empty(); part = parts.next())
      cells.push_back(part);
  }
  return cells;
}

template <typename T>
void
TableRows<T>::takeCell(const TableLine& line, std::string_view cell, TableValue value)
{
  std::string with_point;
  if (layout_.separator != ',' && cell.find(',') != std::string_view::npos) {
    with_point = cell;
    std::replace(with_point.begin(), with_point.end(), ',', '.');
  }
  const std::string_view number = with_point.empty() ? cell : with_point;
  const auto parse = [&](auto& target) {
    target = std::numeric_limits<std::decay_t<decltype(target)>>::quiet_NaN();
    if (!number.empty() && !text::parseNumber(number, target))
      line.fail(text::quoted(cell) + " is not a number");
  };
  value == TableValue::kTime ? parse(time_)
                             : parse(row_[static_cast<std::size_t>(value)]);
}

template <typename T>
void
TableRows<T>::takeCells(const TableLine& line)
{
  const auto cells = split(line);
  const std::size_t columns = layout_.columns.size();
  for (std::size_t i = 0; i < std::min(columns, cells.size()); ++i)
    if (layout_.columns[i] != TableValue::kNone)
      takeCell(line, cells[i], layout_.columns[i]);
  if (cells.size() < columns)
    line.fail("expected at least " + std::to_string(columns) + " numbers, got " +
              std::to_string(cells.size()));
  if (further_line_ == 0 && layout_.left_out.empty() && cells.size() > columns)
    further_line_ = line.number;
}

template <typename T>
bool
TableRows<T>::take(const TableLine& line, std::vector<std::uint8_t>& data)
{
  if (!takePlain(line.text)) {
    if (text::isBlank(line.text) || isRemark(line.text))
      return false;
    takeCells(line);
  }
  if (has_colours_ && bright_line_ == 0)
    for (const auto value : {TableValue::kRed, TableValue::kGreen, TableValue::kBlue})
      if (row_[static_cast<std::size_t>(value)] > 255)
        bright_line_ = line.number;
  append(data);
  return true;
}

template <typename T>
void
TableRows<T>::append(std::vector<std::uint8_t>& data)
{
  const auto number = [&](TableValue value) {
    return row_[static_cast<std::size_t>(value)];
  };
  data.resize(data.size() + point_step_);
  std::uint8_t* place = data.data() + data.size() - point_step_;
  for (const auto value : {TableValue::kX, TableValue::kY, TableValue::kZ})
    place = put(place, number(value));
  if (has_intensity_)
    place = put(place, static_cast<float>(number(TableValue::kIntensity)));
  if (has_colours_) {
    std::uint32_t rgb = 0;
    for (const auto value : {TableValue::kRed, TableValue::kGreen, TableValue::kBlue}) {
      const auto level = static_cast<double>(number(value));
      rgb = rgb << 8 | clampedTo<std::uint8_t>(std::isnan(level) ? 0.0 : level);
    }
    place = put(place, rgb);
  }
  if (has_normals_)
    for (const auto value :
         {TableValue::kNormalX, TableValue::kNormalY, TableValue::kNormalZ})
      place = put(place, static_cast<float>(number(value)));
  if (has_ring_) {
    const auto ring = static_cast<double>(number(TableValue::kRing));
    place = put(place, clampedTo<std::uint16_t>(std::isnan(ring) ? 0.0 : ring));
  }
  if (has_time_)
    put(place, time_);
}

template <typename T>
std::string
TableRows<T>::further() const
{
  std::string text;
  if (further_line_ > 0)
    text = "columns behind the first " + std::to_string(layout_.columns.size()) +
           " (line " + std::to_string(further_line_) + ")";
  if (bright_line_ > 0)
    text += std::string(text.empty() ? "" : ", ") + "colours above 255 (line " +
            std::to_string(bright_line_) + ")";
  return text;
}

template class TableRows<float>;
template class TableRows<double>;

} // namespace pcl6d::io
