// SPDX-License-Identifier: BSD-3-Clause
#include "json/json_place.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

namespace pcl6d::semantic_map {
namespace {
/** The value, shortened. */
std::string
excerpt(const Json& json)
{
  constexpr std::size_t kLongest = 40;
  const std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace);
  return text.size() <= kLongest ? text : text.substr(0, kLongest - 3) + "...";
}
} // namespace

void
JsonPlace::fail(const std::string& message) const
{
  throw IoFailed(file_ + ": " + (pointer_.empty() ? "" : pointer_ + ": ") + message);
}

void
JsonPlace::require(bool kept, const std::string& rule) const
{
  if (!kept)
    fail(excerpt(json_) + ", but must be " + rule);
}

JsonPlace
JsonPlace::operator/(const std::string& key) const
{
  require(json_.is_object(), "an object");
  const auto member = json_.find(key);
  if (member == json_.end())
    fail("has no '" + key + "'");
  return {*member, file_, pointer_ + '/' + key};
}

std::optional<JsonPlace>
JsonPlace::find(const std::string& key) const
{
  require(json_.is_object(), "an object");
  const auto member = json_.find(key);
  if (member == json_.end() || member->is_null())
    return {};
  return JsonPlace(*member, file_, pointer_ + '/' + key);
}

void
JsonPlace::forEach(const std::function<void(const JsonPlace&)>& body) const
{
  require(json_.is_array(), "an array");
  for (std::size_t i = 0; i < json_.size(); ++i)
    body({json_[i], file_, pointer_ + '/' + std::to_string(i)});
}

double
JsonPlace::number() const
{
  require(json_.is_number() && std::isfinite(json_.get<double>()), "a finite number");
  return json_.get<double>();
}

std::size_t
JsonPlace::count() const
{
  require(json_.is_number_unsigned(), "a whole number >= 0");
  return json_.get<std::size_t>();
}

int
JsonPlace::integer() const
{
  require(json_.is_number_integer() && std::abs(json_.get<double>()) < 1e9,
          "a whole number");
  return json_.get<int>();
}

bool
JsonPlace::boolean() const
{
  require(json_.is_boolean(), "true or false");
  return json_.get<bool>();
}

std::string
JsonPlace::text() const
{
  require(json_.is_string(), "text");
  return json_.get<std::string>();
}

std::vector<std::size_t>
JsonPlace::counts() const
{
  std::vector<std::size_t> values;
  forEach([&](const JsonPlace& element) { values.push_back(element.count()); });
  return values;
}

std::vector<double>
JsonPlace::numbers(std::size_t size) const
{
  std::vector<double> values;
  const std::function<void(const JsonPlace&)> take = [&](const JsonPlace& element) {
    if (element.json_.is_array())
      element.forEach(take);
    else
      values.push_back(element.number());
  };
  forEach(take);
  if (values.size() != size)
    fail("expected " + std::to_string(size) + " numbers, got " +
         std::to_string(values.size()));
  return values;
}

Eigen::Vector3d
JsonPlace::vector3() const
{
  Eigen::Vector3d vector;
  fill(vector);
  return vector;
}

std::vector<Eigen::Vector3d>
JsonPlace::points() const
{
  std::vector<Eigen::Vector3d> points;
  forEach([&](const JsonPlace& element) { points.push_back(element.vector3()); });
  return points;
}

Eigen::Isometry3d
JsonPlace::pose() const
{
  Eigen::Isometry3d pose;
  fill(pose.matrix());
  require(isRigid(pose) && pose.matrix().row(3) == Eigen::RowVector4d(0, 0, 0, 1),
          "a rigid motion");
  return pose;
}

Eigen::Matrix<double, 6, 6>
JsonPlace::matrix6() const
{
  Eigen::Matrix<double, 6, 6> matrix;
  fill(matrix);
  return matrix;
}

void
readJson(const std::string& file, const std::function<void(const JsonPlace&)>& take)
{
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content; // its operator<< catches what reading a folder throws
  content << stream.rdbuf();
  if (!stream.is_open() || content.bad() || errno == EISDIR)
    throw IoFailed(file + ": cannot be read: " +
                   (errno != 0 ? std::strerror(errno) : "unknown reason"));
  Json json;
  try {
    json = Json::parse(content.str());
  } catch (const Json::exception& error) {
    const std::string message = error.what();
    const std::size_t end = message.find("] ");
    throw IoFailed(file + ": is no JSON: " +
                   (end == std::string::npos ? message : message.substr(end + 2)));
  }
  take(JsonPlace(json, file));
}

} // namespace pcl6d::semantic_map
