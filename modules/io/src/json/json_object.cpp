// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/json_numbers.h>
#include <pcl6d/io/json_object.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

namespace pcl6d {
namespace {
using Json = JsonValue::Json;

bool
isFinite(const Json& json)
{
  return json.is_number() && std::isfinite(json.get<double>());
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
  return {file_, {json_, &json}, pointer_ + '/' + name};
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
JsonValue::require(bool kept, const std::string& rule) const
{
  if (!kept)
    fail(excerpt() + ", but must be " + rule);
}

std::string
JsonValue::excerpt() const
{
  constexpr std::size_t kLongest = 40;
  const std::string text = json_->dump(-1, ' ', false, Json::error_handler_t::replace);
  return text.size() > kLongest ? text.substr(0, kLongest) + "..." : text;
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
JsonValue::find(const std::string& key) const
{
  if (isObject() && !has(key))
    return {};
  const JsonValue member = *this / key;
  return member.isNull() ? std::nullopt : std::make_optional(member);
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
JsonValue::allow(std::initializer_list<const char*> known) const
{
  for (const auto& key : keys())
    if (std::find(known.begin(), known.end(), key) == known.end())
      fail("unknown key '" + key + "'");
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
      part(element, std::to_string(i)).number(); // which refuses it
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

Eigen::Vector3d
JsonValue::vector3() const
{
  Eigen::Vector3d vector;
  fill(vector);
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
  return pose;
}

Eigen::Matrix<double, 6, 6>
JsonValue::matrix6() const
{
  Eigen::Matrix<double, 6, 6> matrix;
  fill(matrix);
  return matrix;
}

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
  static const Json kEmpty = Json::object();
  const auto json = member(key);
  return {json ? *json : value_.part(kEmpty, key)};
}

void
JsonObject::finish() const
{
  for (const auto& key : keys())
    if (read_.count(key) == 0)
      value_.fail("unknown key '" + key + "'");
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

JsonValue
parseJson(const std::string& text, const std::string& name)
{
  try {
    return {name, Json::parse(text, nullptr, true, true)}; // comments are allowed
  } catch (const Json::parse_error& e) {
    const auto end =
        text.begin() + static_cast<std::ptrdiff_t>(std::min(e.byte, text.size()));
    const auto line = 1 + std::count(text.begin(), end, '\n');
    throw IoFailed(name + ": line " + std::to_string(line) +
                   ": not the syntax of JSON");
  } catch (const Json::exception& e) {
    throw IoFailed(name + ": " + e.what());
  }
}

JsonValue
readJson(const std::filesystem::path& file)
{
  std::ifstream stream(file, std::ios::binary);
  if (!stream || stream.peek() == std::char_traits<char>::eof())
    throw IoFailed(file.string() + ": cannot be read or is empty");
  return parseJson({std::istreambuf_iterator<char>(stream), {}}, file.string());
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

void
fill(const Json& json, const std::string& name, Eigen::Ref<Eigen::MatrixXd> matrix)
{
  const auto values = json.get<std::vector<double>>();
  if (values.size() != static_cast<std::size_t>(matrix.size()))
    throw std::invalid_argument(name + ": expected " + std::to_string(matrix.size()) +
                                " numbers, got " + std::to_string(values.size()));
  for (Eigen::Index i = 0; i < matrix.size(); ++i)
    matrix(i / matrix.cols(), i % matrix.cols()) = values[static_cast<std::size_t>(i)];
}

std::string
reasonOf(const std::exception& error)
{
  const std::string message = error.what();
  const std::size_t end = message.find("] ");
  return end == std::string::npos ? message : message.substr(end + 2);
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
