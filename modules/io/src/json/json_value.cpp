// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/number_range.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/io/json_object.h>
#include <pcl6d/io/text.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace pcl6d {
namespace {
using Json = JsonValue::Json;

constexpr std::size_t kLongestShown = 40; // [byte] of a key or a value in a message

bool
isFinite(const Json& json)
{
  return json.is_number() && std::isfinite(json.get<double>());
}

/** \return the text, shortened between two characters of UTF-8 */
std::string
shortened(const std::string& text)
{
  if (text.size() <= kLongestShown)
    return text;
  std::size_t end = kLongestShown;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80)
    --end; // inside a character
  return text.substr(0, end) + "...";
}

/** \return a key for JSON pointers in messages: on one line, and shortened */
std::string
pointerName(const std::string& key)
{
  std::string text = shortened(key);
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f')
      c = '?';
  return text;
}
} // namespace

JsonValue::JsonValue(std::string file, Json json)
: file_(std::make_shared<const std::string>(std::move(file)))
, json_(std::make_shared<const Json>(std::move(json)))
{}

JsonValue::JsonValue(std::shared_ptr<const std::string> file,
                     std::shared_ptr<const Json> json,
                     std::string pointer)
: file_(std::move(file)), json_(std::move(json)), pointer_(std::move(pointer))
{}

JsonValue
JsonValue::part(const Json& json, const std::string& name) const
{
  return {file_, {json_, &json}, pointer_ + '/' + pointerName(name)};
}

std::string
JsonValue::place() const
{
  return *file_ + ": " + (pointer_.empty() ? "/" : pointer_);
}

void
JsonValue::fail(const std::string& message) const
{
  throw IoFailed(place() + ": " + message);
}

void
JsonValue::fail(const std::string& key, const std::string& message) const
{
  part(*json_, key).fail(message);
}

void
JsonValue::require(bool kept, const std::string& rule) const
{
  if (!kept)
    fail(excerpt() + ", but must be " + rule);
}

std::string
JsonValue::excerpt() const
{
  return shortened(json_->dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::string
JsonValue::dump() const
{
  return json_->dump();
}

bool
JsonValue::isObject() const
{
  return json_->is_object();
}

bool
JsonValue::isArray() const
{
  return json_->is_array();
}

bool
JsonValue::isText() const
{
  return json_->is_string();
}

bool
JsonValue::isNull() const
{
  return json_->is_null();
}

bool
JsonValue::isNumber() const
{
  return isFinite(*json_);
}

bool
JsonValue::isPair() const
{
  return isArray() && json_->size() == 2;
}

bool
JsonValue::has(const std::string& key) const
{
  return json_->contains(key);
}

JsonValue
JsonValue::operator/(const std::string& key) const
{
  if (!isObject())
    fail(excerpt() + " is no object {...}");
  const auto member = json_->find(key);
  if (member == json_->end())
    fail("key '" + key + "' is missing");
  return part(*member, key);
}

std::optional<JsonValue>
JsonValue::member(const std::string& key) const
{
  if (isObject() && !has(key))
    return {};
  return *this / key;
}

std::optional<JsonValue>
JsonValue::find(const std::string& key) const
{
  const std::optional<JsonValue> found = member(key);
  return found && found->isNull() ? std::nullopt : found;
}

std::vector<std::string>
JsonValue::keys() const
{
  if (!isObject())
    fail(excerpt() + " is no object {...}");
  std::vector<std::string> keys;
  for (const auto& entry : json_->items())
    keys.push_back(entry.key());
  return keys;
}

void
JsonValue::allow(const std::vector<std::string>& known) const
{
  for (const auto& key : keys())
    if (std::find(known.begin(), known.end(), key) == known.end())
      fail("unknown key " + text::quoted(key));
}

std::vector<JsonValue>
JsonValue::elements() const
{
  if (!isArray())
    fail(excerpt() + " is no array [...]");
  std::vector<JsonValue> elements;
  elements.reserve(json_->size());
  for (const Json& element : *json_)
    elements.push_back(part(element, std::to_string(elements.size())));
  return elements;
}

std::vector<JsonValue>
JsonValue::elements(const std::string& key) const
{
  return has(key) ? (*this / key).elements() : std::vector<JsonValue>();
}

double
JsonValue::number() const
{
  if (!isNumber())
    fail(excerpt() + " is not a number");
  return json_->get<double>();
}

std::size_t
JsonValue::count() const
{
  if (!json_->is_number_unsigned())
    fail(excerpt() + " is not a whole number >= 0");
  return json_->get<std::size_t>();
}

int
JsonValue::integer() const
{
  constexpr double kLargest = 1000000;
  if (!json_->is_number_integer() || std::abs(json_->get<double>()) > kLargest)
    fail(excerpt() + " is not a whole number up to a million");
  return json_->get<int>();
}

bool
JsonValue::boolean() const
{
  require(json_->is_boolean(), "true or false");
  return json_->get<bool>();
}

std::string
JsonValue::text() const
{
  if (!isText())
    fail(excerpt() + " is not a text \"...\"");
  return json_->get<std::string>();
}

std::vector<std::size_t>
JsonValue::counts() const
{
  std::vector<std::size_t> values;
  for (const auto& element : elements())
    values.push_back(element.count());
  return values;
}

std::vector<double>
JsonValue::numbers() const
{
  if (!isArray())
    fail(excerpt() + " is no array [...]");
  std::vector<double> values;
  for (const Json& value : *json_) {
    if (!isFinite(value))
      fail(JsonValue(file_, {json_, &value}, "").excerpt() + " is not a number");
    values.push_back(value.get<double>());
  }
  return values;
}

void
JsonValue::appendNumbers(std::vector<double>& values) const
{
  if (!isArray())
    fail(excerpt() + " is no array [...]");
  for (std::size_t i = 0; i < json_->size(); ++i) {
    const Json& element = (*json_)[i];
    if (isFinite(element))
      values.push_back(element.get<double>());
    else if (element.is_array())
      part(element, std::to_string(i)).appendNumbers(values);
    else
      part(element, std::to_string(i)).number(); // throws
  }
}

void
JsonValue::fill(Eigen::Ref<Eigen::MatrixXd> matrix) const
{
  std::vector<double> values;
  appendNumbers(values);
  if (values.size() != static_cast<std::size_t>(matrix.size()))
    fail("expected " + std::to_string(matrix.size()) + " numbers, got " +
         std::to_string(values.size()));
  for (Eigen::Index i = 0; i < matrix.size(); ++i)
    matrix(i / matrix.cols(), i % matrix.cols()) = values[static_cast<std::size_t>(i)];
}

Eigen::Vector2d
JsonValue::vector2() const
{
  Eigen::Vector2d vector;
  fill(vector);
  require(isPlace(vector), "two numbers below 1e9");
  return vector;
}

Eigen::Vector3d
JsonValue::vector3() const
{
  Eigen::Vector3d vector;
  fill(vector);
  require(isPlace(vector), "three numbers below 1e9");
  return vector;
}

std::vector<Eigen::Vector3d>
JsonValue::points() const
{
  std::vector<Eigen::Vector3d> points;
  for (const auto& element : elements())
    points.push_back(element.vector3());
  return points;
}

Eigen::Isometry3d
JsonValue::pose() const
{
  Eigen::Isometry3d pose;
  fill(pose.matrix());
  require(isRigid(pose) && pose.matrix().row(3) == Eigen::RowVector4d(0, 0, 0, 1),
          "a rigid motion");
  require(isPlace(pose.translation()), "a position within 1e9 m");
  return pose;
}

Eigen::Matrix<double, 6, 6>
JsonValue::matrix6() const
{
  Eigen::Matrix<double, 6, 6> matrix;
  fill(matrix);
  return matrix;
}

} // namespace pcl6d
