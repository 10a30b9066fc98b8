// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Geometry>
#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

/** \file JSON files, with errors that name the file and the position. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief A value of a JSON document with its path; keeps the document alive. A missing value or
 * a wrong type throws IoFailed "file: /planes/3/area: ..." */
class JsonValue {
public:
  using Json = nlohmann::ordered_json;

  /** \brief The whole of a document. \param[in] file name, for messages */
  JsonValue(std::string file, Json json);

  /** \throws IoFailed "file: /pointer: message" */
  [[noreturn]] void
  fail(const std::string& message) const;

  /** \throws IoFailed "... value, but must be rule" unless the rule is kept */
  void
  require(bool kept, const std::string& rule) const;

  bool
  isObject() const;
  bool
  isArray() const;
  bool
  isText() const;
  bool
  isNull() const;

  /** \return whether the value is a finite number */
  bool
  isNumber() const;

  /** \return whether the value is an array of two */
  bool
  isPair() const;

  /** \return the member of an object, which must exist */
  JsonValue
  operator/(const std::string& key) const;

  bool
  has(const std::string& key) const;

  /** \return the member of an object; empty if missing or null */
  std::optional<JsonValue>
  find(const std::string& key) const;

  /** \return the keys of an object, in the order of the file */
  std::vector<std::string>
  keys() const;

  /** \throws IoFailed an object has a key that is not listed */
  void
  allow(std::initializer_list<const char*> known) const;

  /** \return the elements of an array */
  std::vector<JsonValue>
  elements() const;

  /** \return the elements of the array under a key, which may be missing */
  std::vector<JsonValue>
  elements(const std::string& key) const;

  /** \return a finite number */
  double
  number() const;

  /** \return a whole number >= 0 */
  std::size_t
  count() const;

  /** \return a whole number up to a million */
  int
  integer() const;
  bool
  boolean() const;
  std::string
  text() const;
  std::vector<std::size_t>
  counts() const;

  /** \return the numbers of an array; an error names the array */
  std::vector<double>
  numbers() const;

  /** \brief Copies the numbers into the matrix, row by row; the number of values must match,
   * rows may be arrays. */
  void
  fill(Eigen::Ref<Eigen::MatrixXd> matrix) const;

  Eigen::Vector3d
  vector3() const;
  std::vector<Eigen::Vector3d>
  points() const;

  /** \return 16 numbers, row by row, checked to be a rigid motion */
  Eigen::Isometry3d
  pose() const;

  /** \return six rows of six numbers */
  Eigen::Matrix<double, 6, 6>
  matrix6() const;

  /** \return the value as JSON text, shortened */
  std::string
  excerpt() const;

  /** \return the whole value as JSON text \throws nlohmann's exceptions for invalid UTF-8 */
  std::string
  dump() const;

  const Json&
  json() const
  {
    return *json_;
  }

  /** \return "file: /pointer" */
  std::string
  place() const;

private:
  friend class JsonObject;
  JsonValue(std::shared_ptr<const std::string> file,
            std::shared_ptr<const Json> json,
            std::string pointer);

  /** \return a member of the value, under the same owner */
  JsonValue
  part(const Json& json, const std::string& name) const;
  void
  appendNumbers(std::vector<double>& values) const;

  std::shared_ptr<const std::string> file_;
  std::shared_ptr<const Json> json_; ///< shares the document
  std::string pointer_;
};

/** \brief An object {...} of a JSON file, read key by key; reports unread keys as errors. */
class JsonObject {
public:
  /** \throws IoFailed the value is not an object */
  JsonObject(JsonValue value);

  bool
  has(const std::string& key) const
  {
    return value_.has(key);
  }

  /** \brief Reads a number, if present. \throws IoFailed the value is not a number */
  void
  read(const std::string& key, double& value);
  void
  read(const std::string& key, int& value);
  void
  read(const std::string& key, std::uint64_t& value);
  void
  read(const std::string& key, std::string& value);
  void
  read(const std::string& key, Eigen::Vector2d& value);
  void
  read(const std::string& key, Eigen::Vector3d& value);

  /** \brief Reads a required value. */
  template <typename T>
  T
  get(const std::string& key)
  {
    require(key);
    T value{};
    read(key, value);
    return value;
  }

  /** \return the numbers of an array */
  std::vector<double>
  numbers(const std::string& key);

  /** \brief Calls f with each element of an array, which may be missing. */
  void
  each(const std::string& key, const std::function<void(const JsonValue&)>& f);

  /** \brief Calls f with each object of an array, which may be missing, and checks that f read
   * every key. */
  void
  eachObject(const std::string& key, const std::function<void(JsonObject&)>& f);

  /** \return the object; an empty object if missing */
  JsonObject
  object(const std::string& key);

  /** \return all keys */
  std::vector<std::string>
  keys() const
  {
    return value_.keys();
  }

  /** \throws IoFailed a key was never read */
  void
  finish() const;

  /** \throws IoFailed the key is missing */
  void
  require(const std::string& key) const;

  /** \throws IoFailed "file: /pointer/key: message" */
  [[noreturn]] void
  fail(const std::string& key, const std::string& message) const;

private:
  std::optional<JsonValue>
  member(const std::string& key);

  JsonValue value_;
  std::set<std::string> read_;
};

/** \return the document; comments are allowed \param[in] name of the file, for messages
 * \throws IoFailed naming file and line */
JsonValue
parseJson(const std::string& text, const std::string& name);

/** \return the content of a JSON file \throws IoFailed naming file and line */
JsonValue
readJson(const std::filesystem::path& file);

/** \return the text as a JSON string in ASCII; invalid UTF-8 is replaced */
std::string
jsonText(const std::string& text);

bool
isUtf8(const std::string& text);

} // namespace pcl6d
