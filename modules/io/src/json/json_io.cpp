// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/json_numbers.h>
#include <pcl6d/io/json_object.h>
#include <pcl6d/io/nesting.h>
#include <pcl6d/io/text.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace pcl6d {
namespace {
using Json = JsonValue::Json;
} // namespace

JsonValue
parseJson(const std::string& text, const std::string& name)
{
  checkJsonNesting(text, name);
  try {
    return {name, Json::parse(text, nullptr, true, true)}; // comments are allowed
  } catch (const Json::parse_error& e) {
    const auto end =
        text.begin() + static_cast<std::ptrdiff_t>(std::min(e.byte, text.size()));
    const auto line = 1 + std::count(text.begin(), end, '\n');
    throw IoFailed(name + ": line " + std::to_string(line) +
                   ": not the syntax of JSON");
  } catch (const Json::out_of_range&) {
    throw IoFailed(name + ": a number is too large for a double");
  }
}

JsonValue
readJson(const std::filesystem::path& file)
{
  const std::string content = text::readFile(file);
  if (content.empty())
    text::fail(file, "is empty");
  return parseJson(content, file.string());
}

std::string
jsonText(const std::string& text)
{
  return Json(text).dump(-1, ' ', true, Json::error_handler_t::replace);
}

bool
isUtf8(const std::string& text)
{
  try {
    Json(text).dump();
    return true;
  } catch (const Json::exception&) {
    return false;
  }
}

Json
rowByRow(const Eigen::Ref<const Eigen::MatrixXd>& matrix)
{
  Json numbers = Json::array();
  for (Eigen::Index row = 0; row < matrix.rows(); ++row)
    for (Eigen::Index column = 0; column < matrix.cols(); ++column)
      numbers.push_back(matrix(row, column));
  return numbers;
}

Json
finiteOrNull(double value)
{
  return std::isfinite(value) ? Json(value) : Json();
}

Json
numberOrNull(const std::optional<double>& value)
{
  return value ? Json(*value) : Json();
}

std::string
jsonFileText(const Json& json, int indent)
{
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + '\n';
}

void
writeJson(const std::filesystem::path& path, const Json& json, int indent)
{
  const std::string text = jsonFileText(json, indent);
  writeFileAtomically(path, [&](std::ostream& stream) { stream << text; });
}

} // namespace pcl6d
