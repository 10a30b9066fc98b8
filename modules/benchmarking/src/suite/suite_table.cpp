// SPDX-License-Identifier: BSD-3-Clause
#include "suite/table_text.h"

#include <pcl6d/benchmarking/suite_table.h>
#include <pcl6d/common/angle.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>

namespace pcl6d {

namespace {
using Json = nlohmann::ordered_json;
using Number = std::optional<double>;
using benchmarking::cellOf;
using benchmarking::csvField;
using benchmarking::fixedText;

/** A column of numbers. */
struct Column {
  std::string key;   ///< in CSV and JSON
  std::string title; ///< in Markdown; empty: left out
  double unit;       ///< Markdown shows value x unit
  int digits;        ///< behind the point, in Markdown
  std::function<Number(const SuiteRow&)> value;
};

/** A column with one number of the errors. */
Column
errorColumn(const std::string& key,
            const std::string& title,
            double unit,
            ErrorStatistics TrajectoryErrors::*kind,
            double ErrorStatistics::*number)
{
  return {key, title, unit, 3, [=](const SuiteRow& row) -> Number {
            if (!row.errors)
              return std::nullopt;
            return row.errors->without_alignment.*kind.*number;
          }};
}

/** A column of the rms of the motions from pose to pose. */
Column
stepColumn(const std::string& key,
           const std::string& title,
           double unit,
           ErrorStatistics RelativeErrors::*kind)
{
  return {key, title, unit, 4, [=](const SuiteRow& row) -> Number {
            if (!row.steps || row.steps->motions.empty())
              return std::nullopt;
            return (*row.steps.*kind).rms;
          }};
}

/** A column with drift per metre. */
Column
driftColumn(const std::string& key,
            const std::string& title,
            double unit,
            double DriftErrors::*number)
{
  return {key, title, unit, 3, [=](const SuiteRow& row) -> Number {
            if (!row.drift || row.drift->stretches == 0)
              return std::nullopt;
            return *row.drift.*number;
          }};
}

const std::vector<Column>&
columns()
{
  using Errors = TrajectoryErrors;
  using Statistics = ErrorStatistics;
  static const std::vector<Column> kColumns = {
      errorColumn("sigma_position_2d_m",
                  "sigma pos [m]",
                  1,
                  &Errors::position_2d,
                  &Statistics::rms),
      errorColumn("max_position_2d_m",
                  "max pos [m]",
                  1,
                  &Errors::position_2d,
                  &Statistics::max),
      errorColumn("sigma_yaw_rad",
                  "sigma yaw [deg]",
                  degrees(1),
                  &Errors::yaw,
                  &Statistics::rms),
      errorColumn(
          "max_yaw_rad", "max yaw [deg]", degrees(1), &Errors::yaw, &Statistics::max),
      errorColumn(
          "rms_position_m", "3D rms [m]", 1, &Errors::position, &Statistics::rms),
      errorColumn("max_position_m", "", 1, &Errors::position, &Statistics::max),
      errorColumn("rms_orientation_rad",
                  "",
                  degrees(1),
                  &Errors::orientation,
                  &Statistics::rms),
      errorColumn("max_orientation_rad",
                  "",
                  degrees(1),
                  &Errors::orientation,
                  &Statistics::max),
      stepColumn("rpe_step_rms_m", "RPE/step [m]", 1, &RelativeErrors::translation),
      stepColumn("rpe_step_rms_rad", "", degrees(1), &RelativeErrors::rotation),
      driftColumn(
          "drift_per_metre", "drift [%]", 100, &DriftErrors::translation_per_metre),
      driftColumn(
          "drift_rad_per_metre", "", degrees(1), &DriftErrors::rotation_per_metre),
      {"agreement", "agreement", 1, 3, [](const auto& row) { return row.agreement; }},
      {"seconds", "time [s]", 1, 1, [](const auto& row) { return row.seconds; }},
      {"cpu_seconds", "", 1, 1, [](const auto& row) { return row.cpu_seconds; }},
      {"peak_memory_mb", "memory [MB]", 1, 0, [](const auto& row) {
         return row.peak_memory_mb;
       }}};
  return kColumns;
}

/** The columns of a Markdown table that are not empty for the rows. */
std::vector<const Column*>
columnsFor(const std::vector<SuiteRow>& rows)
{
  std::vector<const Column*> shown;
  for (const Column& column : columns())
    if (!column.title.empty() &&
        std::any_of(rows.begin(), rows.end(), [&](const SuiteRow& row) {
          return column.value(row).has_value();
        }))
      shown.push_back(&column);
  return shown;
}

/** \return the shortest text that reads back as an equal number */
std::string
exactly(const Number& value)
{
  return value ? Json(*value).dump() : "";
}

Json
toJson(const ErrorStatistics& errors)
{
  return {{"rms", errors.rms},
          {"mean", errors.mean},
          {"median", errors.median},
          {"max", errors.max}};
}
} // namespace

std::string
suiteMarkdown(const std::vector<SuiteRow>& rows)
{
  const bool several = std::any_of(rows.begin(), rows.end(), [&](const SuiteRow& row) {
    return row.data != rows.front().data;
  });
  const auto shown = columnsFor(rows);
  std::string head = several ? "| data | method |" : "| method |";
  std::string rule = several ? "|---|---|" : "|---|";
  for (const Column* column : shown) {
    head += ' ' + column->title + " |";
    rule += "---|";
  }
  std::string text = head + " verdict |\n" + rule + "---|\n", messages;
  for (const SuiteRow& row : rows) {
    text += several ? "| " + cellOf(row.data) + " | " : "| ";
    text += cellOf(row.method) + " |";
    for (const Column* column : shown) {
      const Number value = column->value(row);
      text +=
          ' ' + (value ? fixedText(column->unit * *value, column->digits) : "-") + " |";
    }
    text += ' ' + (row.verdict.empty() ? "-" : cellOf(row.verdict)) + " |\n";
    if (!row.message.empty())
      messages += "- " + (several ? row.data + ", " : "") + row.method + ": " +
                  row.message + '\n';
  }
  return messages.empty() ? text : text + '\n' + messages;
}

std::string
suiteCsv(const std::vector<SuiteRow>& rows)
{
  std::string text = "data,method";
  for (const Column& column : columns())
    text += ',' + column.key;
  text += ",runs,verdict,message\n";
  for (const SuiteRow& row : rows) {
    text += csvField(row.data) + ',' + csvField(row.method);
    for (const Column& column : columns())
      text += ',' + exactly(column.value(row));
    text += ',' + std::to_string(row.runs) + ',' + csvField(row.verdict) + ',' +
            csvField(row.message) + '\n';
  }
  return text;
}

std::string
suiteJson(const std::vector<SuiteRow>& rows)
{
  Json list = Json::array();
  for (const SuiteRow& row : rows) {
    Json json = {{"data", row.data}, {"method", row.method}};
    for (const Column& column : columns()) {
      const Number value = column.value(row);
      json[column.key] = value ? Json(*value) : Json();
    }
    json["with_alignment"] = nullptr;
    if (row.errors) {
      const TrajectoryErrors& aligned = row.errors->with_alignment;
      json["with_alignment"] = {{"position", toJson(aligned.position)},
                                {"orientation", toJson(aligned.orientation)}};
    }
    json["runs"] = row.runs;
    json["verdict"] = row.verdict;
    json["message"] = row.message;
    list.push_back(json);
  }
  const Json json = {{"schema_version", 1}, {"rows", list}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

} // namespace pcl6d
