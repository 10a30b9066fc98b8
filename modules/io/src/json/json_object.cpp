// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/io/json_object.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

namespace pcl6d {
namespace {
using Json = JsonObject::Json;

[[noreturn]] void
failAt(const std::filesystem::path& file,
       const std::string& pointer,
       const std::string& message)
{
  throw IoFailed(file.string() + ": " + (pointer.empty() ? "/" : pointer) + ": " +
                 message);
}

std::string
shortText(const Json& json)
{
  constexpr std::size_t kLongest = 40;
  std::string text = json.dump();
  if (text.size() > kLongest)
    text = text.substr(0, kLongest) + "...";
  return text;
}
} // namespace

JsonObject::JsonObject(const std::filesystem::path& file,
                       const Json& json,
                       std::string pointer)
: file_(file), json_(json), pointer_(std::move(pointer))
{
  if (!json.is_object())
    failAt(file_, pointer_, shortText(json) + " is no object {...}");
}

const Json*
JsonObject::find(const std::string& key)
{
  read_.insert(key);
  const auto found = json_.find(key);
  return found == json_.end() ? nullptr : &*found;
}

void
JsonObject::read(const std::string& key, double& value)
{
  const Json* const json = find(key);
  if (!json)
    return;
  if (!json->is_number() || !std::isfinite(json->get<double>()))
    fail(key, shortText(*json) + " is not a number");
  value = json->get<double>();
}

void
JsonObject::read(const std::string& key, int& value)
{
  const Json* const json = find(key);
  if (!json)
    return;
  constexpr std::int64_t kLargest = 1000000;
  if (!json->is_number_integer() || json->get<std::int64_t>() < -kLargest ||
      json->get<std::int64_t>() > kLargest)
    fail(key, shortText(*json) + " is not a whole number up to a million");
  value = json->get<int>();
}

void
JsonObject::read(const std::string& key, std::uint64_t& value)
{
  const Json* const json = find(key);
  if (!json)
    return;
  if (!json->is_number_unsigned())
    fail(key, shortText(*json) + " is not a whole number >= 0");
  value = json->get<std::uint64_t>();
}

void
JsonObject::read(const std::string& key, std::string& value)
{
  const Json* const json = find(key);
  if (!json)
    return;
  if (!json->is_string())
    fail(key, shortText(*json) + " is not a text \"...\"");
  value = json->get<std::string>();
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
}

std::vector<double>
JsonObject::numbers(const std::string& key)
{
  require(key);
  return jsonNumbers(file_, *find(key), pointer_ + "/" + key);
}

void
JsonObject::each(const std::string& key,
                 const std::function<void(const Json&, const std::string&)>& f)
{
  const Json* const json = find(key);
  if (!json)
    return;
  if (!json->is_array())
    fail(key, shortText(*json) + " is no array [...]");
  for (std::size_t i = 0; i < json->size(); ++i)
    f((*json)[i], pointer_ + "/" + key + "/" + std::to_string(i));
}

void
JsonObject::eachObject(const std::string& key,
                       const std::function<void(JsonObject&)>& f)
{
  each(key, [&](const Json& json, const std::string& pointer) {
    JsonObject object(file_, json, pointer);
    try {
      f(object);
    } catch (const BadArgument& e) { // a rule of a body
      failAt(file_, pointer, e.what());
    }
    object.finish();
  });
}

JsonObject
JsonObject::object(const std::string& key)
{
  static const Json kEmpty = Json::object();
  const Json* const json = find(key);
  return {file_, json ? *json : kEmpty, pointer_ + "/" + key};
}

std::vector<std::string>
JsonObject::keys() const
{
  std::vector<std::string> keys;
  for (const auto& entry : json_.items())
    keys.push_back(entry.key());
  return keys;
}

void
JsonObject::finish() const
{
  for (const auto& key : keys())
    if (read_.count(key) == 0)
      failAt(file_, pointer_, "unknown key '" + key + "'");
}

void
JsonObject::require(const std::string& key) const
{
  if (!has(key))
    failAt(file_, pointer_, "key '" + key + "' is missing");
}

void
JsonObject::fail(const std::string& key, const std::string& message) const
{
  failAt(file_, key.empty() ? pointer_ : pointer_ + "/" + key, message);
}

std::vector<double>
jsonNumbers(const std::filesystem::path& file,
            const Json& json,
            const std::string& pointer)
{
  if (!json.is_array())
    failAt(file, pointer, shortText(json) + " is no array [...]");
  std::vector<double> values;
  for (const auto& value : json) {
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      failAt(file, pointer, shortText(value) + " is not a number");
    values.push_back(value.get<double>());
  }
  return values;
}

Json
readJson(const std::filesystem::path& file)
{
  std::ifstream stream(file, std::ios::binary);
  if (!stream || stream.peek() == std::char_traits<char>::eof())
    throw IoFailed(file.string() + ": cannot be read or is empty");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  try {
    return Json::parse(text, nullptr, true, true); // comments are allowed
  } catch (const Json::parse_error& e) {
    const auto end =
        text.begin() + static_cast<std::ptrdiff_t>(std::min(e.byte, text.size()));
    const auto line = 1 + std::count(text.begin(), end, '\n');
    throw IoFailed(file.string() + ": line " + std::to_string(line) +
                   ": not the syntax of JSON");
  } catch (const Json::exception& e) {
    throw IoFailed(file.string() + ": " + e.what());
  }
}

} // namespace pcl6d
