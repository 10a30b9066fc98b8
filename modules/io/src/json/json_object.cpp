// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/number_range.h>
#include <pcl6d/io/json_object.h>
#include <pcl6d/io/text.h>

#include <nlohmann/json.hpp>

namespace pcl6d {

JsonObject::JsonObject(JsonValue value) : value_(std::move(value))
{
  if (!value_.isObject())
    value_.fail(value_.excerpt() + " is no object {...}");
}

std::optional<JsonValue>
JsonObject::member(const std::string& key)
{
  read_.insert(key);
  return has(key) ? std::make_optional(value_ / key) : std::nullopt;
}

void
JsonObject::read(const std::string& key, double& value)
{
  if (const auto json = member(key))
    value = json->number();
}

void
JsonObject::read(const std::string& key, int& value)
{
  if (const auto json = member(key))
    value = json->integer();
}

void
JsonObject::read(const std::string& key, std::uint64_t& value)
{
  if (const auto json = member(key))
    value = json->count();
}

void
JsonObject::read(const std::string& key, std::string& value)
{
  if (const auto json = member(key))
    value = json->text();
}

void
JsonObject::read(const std::string& key, Eigen::Vector2d& value)
{
  if (!has(key))
    return;
  const std::vector<double> list = numbers(key);
  if (list.size() != 2)
    fail(key, "expected 2 numbers, got " + std::to_string(list.size()));
  value = {list[0], list[1]};
  if (!isPlace(value))
    fail(key, "the numbers must be below 1e9");
}

void
JsonObject::read(const std::string& key, Eigen::Vector3d& value)
{
  if (!has(key))
    return;
  const std::vector<double> list = numbers(key);
  if (list.size() != 3)
    fail(key, "expected 3 numbers, got " + std::to_string(list.size()));
  value = {list[0], list[1], list[2]};
  if (!isPlace(value))
    fail(key, "the numbers must be below 1e9");
}

std::vector<double>
JsonObject::numbers(const std::string& key)
{
  read_.insert(key);
  return (value_ / key).numbers();
}

void
JsonObject::each(const std::string& key, const std::function<void(const JsonValue&)>& f)
{
  if (const auto list = member(key))
    for (const auto& element : list->elements())
      f(element);
}

void
JsonObject::eachObject(const std::string& key,
                       const std::function<void(JsonObject&)>& f)
{
  each(key, [&](const JsonValue& json) {
    JsonObject object(json);
    try {
      f(object);
    } catch (const BadArgument& e) { // a rule of a body
      json.fail(e.what());
    }
    object.finish();
  });
}

JsonObject
JsonObject::object(const std::string& key)
{
  static const JsonValue::Json kEmpty = JsonValue::Json::object();
  const auto json = member(key);
  return {json ? *json : value_.part(kEmpty, key)};
}

void
JsonObject::finish() const
{
  for (const auto& key : keys())
    if (read_.count(key) == 0)
      value_.fail("unknown key " + text::quoted(key));
}

void
JsonObject::require(const std::string& key) const
{
  value_ / key;
}

void
JsonObject::fail(const std::string& key, const std::string& message) const
{
  if (key.empty())
    value_.fail(message);
  value_.part(value_.json(), key).fail(message);
}

} // namespace pcl6d
