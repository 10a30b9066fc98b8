// SPDX-License-Identifier: BSD-3-Clause
#include "text.h"

#include <pcl6d/io/run_summary.h>

#include <nlohmann/json.hpp>

namespace pcl6d {

namespace {
using Json = nlohmann::ordered_json;

/** \return the numbers row by row, checked \param[in] name for messages */
template <typename Matrix>
Matrix
numbersOf(const Json& json, const std::string& name)
{
  const auto values = json.get<std::vector<double>>();
  if (values.size() != static_cast<std::size_t>(Matrix::SizeAtCompileTime))
    throw std::invalid_argument(name + ": expected " +
                                std::to_string(Matrix::SizeAtCompileTime) +
                                " numbers, got " + std::to_string(values.size()));
  Matrix matrix;
  for (Eigen::Index i = 0; i < matrix.size(); ++i)
    matrix(i / matrix.cols(), i % matrix.cols()) = values[static_cast<std::size_t>(i)];
  return matrix;
}

RunSummary::ScanEntry
scanOf(const Json& json)
{
  RunSummary::ScanEntry scan;
  scan.file = json.at("file").get<std::string>();
  scan.T_world_scan.matrix() =
      numbersOf<Eigen::Matrix4d>(json.at("T_world_scan"), "T_world_scan");
  return scan;
}

RunSummary
summaryOf(const Json& json)
{
  RunSummary summary;
  const int schema = json.at("schema_version").get<int>();
  if (schema != RunSummary::kSchemaVersion)
    throw std::invalid_argument("schema_version = " + std::to_string(schema) +
                                ", but must be " +
                                std::to_string(RunSummary::kSchemaVersion));
  summary.generator = json.at("generator").get<std::string>();
  summary.version = json.at("version").get<std::string>();
  summary.world_offset =
      numbersOf<Eigen::Vector3d>(json.at("world_offset"), "world_offset");
  for (const auto& [name, option] : json.at("options").items())
    summary.options.push_back({name,
                               option.at("value").get<std::string>(),
                               option.at("source").get<std::string>(),
                               option.value("why", "")});
  for (const auto& scan : json.at("scans"))
    summary.scans.push_back(scanOf(scan));
  summary.complete = json.at("verdict").at("complete").get<bool>();
  summary.trusted = json.at("verdict").at("trusted").get<bool>();
  return summary;
}

/** \return the message of the JSON library without its number in brackets */
std::string
reasonOf(const Json::exception& error)
{
  const std::string message = error.what();
  const std::size_t end = message.find("] ");
  return end == std::string::npos ? message : message.substr(end + 2);
}
} // namespace

RunSummary
readRunSummary(const std::filesystem::path& path)
{
  const std::string content = text::readFile(path);
  try {
    return summaryOf(Json::parse(content));
  } catch (const Json::exception& error) {
    text::fail(path, reasonOf(error));
  } catch (const std::invalid_argument& error) {
    text::fail(path, error.what());
  }
}

} // namespace pcl6d
