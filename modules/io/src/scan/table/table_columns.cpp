// SPDX-License-Identifier: BSD-3-Clause
#include "scan/table/table_columns.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/io/text.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace pcl6d::io {

namespace {
struct TableWord {
  std::string_view word;
  TableValue value;
};
/** The words of spreadsheets, of CloudCompare, ParaView, VeloView and Livox Viewer. */
constexpr std::array<TableWord, 48> kTableWords = {{
    {"x", TableValue::kX},
    {"easting", TableValue::kX},
    {"points:0", TableValue::kX},
    {"points_m_xyz:0", TableValue::kX},
    {"y", TableValue::kY},
    {"northing", TableValue::kY},
    {"points:1", TableValue::kY},
    {"points_m_xyz:1", TableValue::kY},
    {"z", TableValue::kZ},
    {"elevation", TableValue::kZ},
    {"height", TableValue::kZ},
    {"points:2", TableValue::kZ},
    {"points_m_xyz:2", TableValue::kZ},
    {"intensity", TableValue::kIntensity},
    {"i", TableValue::kIntensity},
    {"scalar_intensity", TableValue::kIntensity},
    {"reflectance", TableValue::kIntensity},
    {"reflectivity", TableValue::kIntensity},
    {"r", TableValue::kRed},
    {"red", TableValue::kRed},
    {"rf", TableValue::kRed},
    {"g", TableValue::kGreen},
    {"green", TableValue::kGreen},
    {"gf", TableValue::kGreen},
    {"b", TableValue::kBlue},
    {"blue", TableValue::kBlue},
    {"bf", TableValue::kBlue},
    {"nx", TableValue::kNormalX},
    {"normal_x", TableValue::kNormalX},
    {"normalx", TableValue::kNormalX},
    {"ny", TableValue::kNormalY},
    {"normal_y", TableValue::kNormalY},
    {"normaly", TableValue::kNormalY},
    {"nz", TableValue::kNormalZ},
    {"normal_z", TableValue::kNormalZ},
    {"normalz", TableValue::kNormalZ},
    {"ring", TableValue::kRing},
    {"laser_id", TableValue::kRing},
    {"laserid", TableValue::kRing},
    {"t", TableValue::kTime},
    {"time", TableValue::kTime},
    {"timestamp", TableValue::kTime},
    {"gps_time", TableValue::kTime},
    {"gpstime", TableValue::kTime},
    {"scalar_gpstime", TableValue::kTime},
    {"scalar_time", TableValue::kTime},
    {"coordinate_x", TableValue::kX},
    {"coordinate_y", TableValue::kY},
}};

constexpr const char* kTableWordsInHelp =
    "x, y, z, intensity, r, g, b, nx, ny, nz, ring, time, or empty";

std::string_view
withoutMargins(std::string_view cell)
{
  const auto is_margin = [](char c) { return c == ' ' || c == '\t' || c == '"'; };
  while (!cell.empty() && is_margin(cell.front()))
    cell.remove_prefix(1);
  while (!cell.empty() && is_margin(cell.back()))
    cell.remove_suffix(1);
  return cell;
}

bool
isDigit(char c)
{
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/** \return whether the token is a number with one comma between digits, e.g. 1,5 */
bool
hasDecimalComma(std::string_view token)
{
  const std::size_t comma = token.find(',');
  return comma != std::string_view::npos && comma > 0 && comma + 1 < token.size() &&
         token.find(',', comma + 1) == std::string_view::npos &&
         isDigit(token[comma - 1]) && isDigit(token[comma + 1]);
}
} // namespace

TableValue
tableValueOf(std::string_view word)
{
  const std::string_view plain =
      withoutMargins(word.substr(0, word.find_first_of("[(")));
  std::string lower(plain);
  for (char& c : lower)
    c = c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const auto& known : kTableWords)
    if (lower == known.word)
      return known.value;
  return TableValue::kNone;
}

std::string
unitOf(std::string_view word)
{
  const std::size_t begin = word.find_first_of("[(");
  if (begin == std::string_view::npos)
    return {};
  const std::size_t end = word.find_first_of("])", begin);
  return std::string(withoutMargins(word.substr(
      begin + 1,
      end == std::string_view::npos ? std::string_view::npos : end - begin - 1)));
}

std::vector<TableValue>
tableColumns(const std::vector<std::string>& words)
{
  std::vector<TableValue> columns;
  for (const auto& word : words) {
    const bool is_left_out = word.empty() || word == "-";
    columns.push_back(is_left_out ? TableValue::kNone : tableValueOf(word));
    if (is_left_out)
      continue;
    if (columns.back() == TableValue::kNone)
      throw BadArgument("columns: " + text::quoted(word) + ", but must be " +
                        kTableWordsInHelp);
    if (std::count(columns.begin(), columns.end(), columns.back()) > 1)
      throw BadArgument("columns: " + text::quoted(word) + " is named twice");
  }
  if (const char* const missing = missingCoordinate(columns))
    throw BadArgument(std::string("columns: ") + missing + " is missing");
  return columns;
}

const char*
missingCoordinate(const std::vector<TableValue>& columns)
{
  constexpr std::array<const char*, 3> kNames = {"x", "y", "z"};
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (std::find(columns.begin(), columns.end(), static_cast<TableValue>(i)) ==
        columns.end())
      return kNames[i];
  return nullptr;
}

std::vector<std::string_view>
cellsOf(std::string_view line, char separator)
{
  std::vector<std::string_view> cells;
  if (separator == ' ') {
    text::Tokens tokens(line);
    for (auto token = tokens.next(); !token.empty(); token = tokens.next())
      cells.push_back(token);
    return cells;
  }
  for (std::size_t begin = 0;;) {
    const std::size_t end = line.find(separator, begin);
    cells.push_back(withoutMargins(line.substr(begin, end - begin)));
    if (end == std::string_view::npos)
      return cells;
    begin = end + 1;
  }
}

char
separatorOf(std::string_view line)
{
  for (const char separator : {';', '\t', ','})
    if (line.find(separator) != std::string_view::npos)
      return separator;
  return ' ';
}

std::string_view
unclearDecimalComma(std::string_view line)
{
  if (line.find(',') == std::string_view::npos ||
      line.find_first_of(";\t") != std::string_view::npos)
    return {};
  const auto tokens = cellsOf(line, ' ');
  if (tokens.size() > 1) { // blanks separate, unless next to a comma
    for (const auto token : tokens)
      if (token.front() == ',' || token.back() == ',')
        return {};
    const auto found = std::find_if(tokens.begin(), tokens.end(), hasDecimalComma);
    return found == tokens.end() ? std::string_view() : *found;
  }
  // Commas only: a leading zero in a second, fourth, ... cell suggests decimals.
  if (line.find('.') != std::string_view::npos)
    return {};
  const auto cells = cellsOf(line, ',');
  for (std::size_t i = 1; i < cells.size(); i += 2)
    if (cells.size() % 2 == 0 && cells[i].size() > 1 && cells[i][0] == '0' &&
        isDigit(cells[i][1]))
      return line.substr(0, line.find(',', line.find(',') + 1));
  return {};
}

} // namespace pcl6d::io

std::vector<std::string>
pcl6d::columnsFromText(const std::string& list)
{
  std::vector<std::string> words;
  for (const auto cell : io::cellsOf(list, ','))
    words.emplace_back(cell);
  io::tableColumns(words);
  return words;
}
