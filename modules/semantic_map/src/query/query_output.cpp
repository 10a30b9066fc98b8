// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/io/json_numbers.h>
#include <pcl6d/semantic_map/map_query.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ostream>

namespace pcl6d {
namespace {
using Json = nlohmann::ordered_json;
using Things = std::vector<Entity>;

std::string
textOf(double number)
{
  if (std::isnan(number))
    return "-";
  std::array<char, 64> buffer{};
  const bool is_whole = std::floor(number) == number && std::abs(number) < 1e15;
  std::snprintf(buffer.data(), buffer.size(), is_whole ? "%.0f" : "%.3f", number);
  return buffer.data();
}

std::string
textOf(const PropertyValue& value)
{
  if (const auto* number = std::get_if<double>(&value))
    return textOf(*number);
  if (const auto* text = std::get_if<std::string>(&value))
    return text->empty() ? "-" : *text;
  std::string list;
  for (const auto& thing : std::get<Things>(value))
    list += (list.empty() ? "" : ",") + toString(thing);
  return list.empty() ? "-" : list;
}

Json
jsonOf(const PropertyValue& value)
{
  if (const auto* number = std::get_if<double>(&value)) {
    const bool is_whole = std::floor(*number) == *number && std::abs(*number) < 1e15;
    return is_whole ? Json(static_cast<std::int64_t>(*number)) : Json(*number);
  }
  if (const auto* text = std::get_if<std::string>(&value))
    return *text;
  Json list = Json::array();
  for (const auto& thing : std::get<Things>(value))
    list.push_back(toString(thing));
  return list;
}

/** \return how many columns a text in UTF-8 takes on a terminal, nearly */
std::size_t
widthOf(const std::string& text)
{
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

struct Cell {
  std::string text;
  bool is_number = false;
};

std::vector<Cell>
cellsOf(const Properties& properties, const std::vector<std::string>& columns)
{
  std::vector<Cell> cells;
  for (const auto& property : properties)
    if (std::find(columns.begin(), columns.end(), property.name) != columns.end())
      cells.push_back(
          {textOf(property.value), std::holds_alternative<double>(property.value)});
  return cells;
}
} // namespace

void
writeTable(std::ostream& stream, const QueryResult& result)
{
  if (result.rows.empty())
    return;
  std::vector<std::vector<Cell>> lines(1);
  const std::vector<Cell> first = cellsOf(result.rows.front(), result.columns);
  for (std::size_t i = 0; i < result.columns.size(); ++i)
    lines[0].push_back({result.columns[i], first[i].is_number});
  for (const auto& row : result.rows)
    lines.push_back(cellsOf(row, result.columns));
  std::vector<std::size_t> widths(result.columns.size(), 0);
  for (const auto& line : lines)
    for (std::size_t i = 0; i < line.size(); ++i)
      widths[i] = std::max(widths[i], widthOf(line[i].text));
  for (const auto& line : lines) {
    std::string text;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const std::string space(widths[i] - widthOf(line[i].text), ' ');
      text += i == 0 ? "" : "  ";
      text += line[i].is_number ? space + line[i].text : line[i].text + space;
    }
    stream << text.substr(0, text.find_last_not_of(' ') + 1) << '\n';
  }
}

void
writeJson(std::ostream& stream, const QueryResult& result)
{
  Json rows = Json::array();
  for (const auto& row : result.rows) {
    Json& json = rows.emplace_back(Json::object());
    for (const auto& property : row)
      json[property.name] = jsonOf(property.value);
  }
  const Json json = {{"schema_version", 1},
                     {"subject", result.subject},
                     {"count", result.rows.size()},
                     {"results", rows}};
  stream << jsonFileText(json);
}

} // namespace pcl6d
