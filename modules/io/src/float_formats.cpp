// SPDX-License-Identifier: BSD-3-Clause
#include "formats.h"
#include "left_handed.h"
#include "text.h"

#include <cstring>

namespace pcl6d {

namespace {

constexpr std::size_t kKittiPoint = 4 * sizeof(float); // x y z intensity
constexpr std::size_t kTextColumns = 3;                // of a point; more are ignored

/** Reads x, y, z from the start of a line. \return false for an empty line */
bool
readPoint(const std::filesystem::path& path,
          std::size_t line,
          text::Tokens tokens,
          Eigen::Vector3f& point)
{
  for (std::size_t i = 0; i < kTextColumns; ++i) {
    const auto token = tokens.next();
    if (token.empty() && i == 0)
      return false;
    if (token.empty())
      text::failAt(path, line, "expected at least 3 numbers, got " + std::to_string(i));
    if (!text::parseNumber(token, point[static_cast<Eigen::Index>(i)]))
      text::failAt(path, line, text::quoted(token) + " is not a number");
  }
  return true;
}

void
append(const Eigen::Vector3f& point, std::vector<float>& values)
{
  values.insert(values.end(), point.data(), point.data() + 3);
}

/** \return whether the first token is text: the line is a heading */
bool
isHeading(text::Tokens tokens)
{
  const auto token = tokens.next();
  float value = 0;
  return !token.empty() && !text::parseNumber(token, value);
}

} // namespace

pcl::PCLPointCloud2
floatCloud(const std::vector<float>& values, const std::vector<std::string>& names)
{
  pcl::PCLPointCloud2 cloud;
  for (const auto& name : names) {
    pcl::PCLPointField field;
    field.name = name;
    field.offset = cloud.point_step;
    field.datatype = pcl::PCLPointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
    cloud.point_step += sizeof(float);
  }
  cloud.height = 1;
  cloud.width = static_cast<pcl::uindex_t>(values.size() / names.size());
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.data.resize(values.size() * sizeof(float));
  if (!values.empty())
    std::memcpy(cloud.data.data(), values.data(), cloud.data.size());
  return cloud;
}

pcl::PCLPointCloud2
readUos(const std::filesystem::path& path)
{
  const std::string content = text::readFile(path);
  std::vector<float> values;
  Eigen::Vector3f point;
  for (text::Lines lines(content); lines.next();) {
    const text::Tokens tokens(lines.line());
    if (lines.number() == 1 && isHeading(tokens))
      continue; // some files start with their number of points and the like
    if (readPoint(path, lines.number(), tokens, point))
      append(fromLeftHanded(point), values);
  }
  return floatCloud(values, {"x", "y", "z"});
}

pcl::PCLPointCloud2
readXyz(const std::filesystem::path& path)
{
  const std::string content = text::readFile(path);
  std::vector<float> values;
  Eigen::Vector3f point;
  for (text::Lines lines(content); lines.next();) {
    const text::Tokens tokens(lines.line(), ",;");
    const auto first = text::Tokens(tokens).next();
    if (first.empty() || first.front() == '#')
      continue;
    if (readPoint(path, lines.number(), tokens, point))
      append(point, values);
  }
  return floatCloud(values, {"x", "y", "z"});
}

pcl::PCLPointCloud2
readKitti(const std::filesystem::path& path)
{
  const std::string content = text::readFile(path);
  if (content.size() % kKittiPoint != 0)
    text::fail(path,
               "its size of " + text::counted(content.size(), "byte") +
                   " is not a multiple of 16 (float32 x y z intensity)");
  std::vector<float> values(content.size() / sizeof(float));
  if (!values.empty())
    std::memcpy(values.data(), content.data(), content.size());
  return floatCloud(values, {"x", "y", "z", "intensity"});
}

} // namespace pcl6d
