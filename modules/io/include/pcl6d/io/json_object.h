// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <functional>
#include <set>
#include <string>

/** \file Objects of a JSON file, read key by key. Who includes it links nlohmann-json. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief One object {...} of a JSON file: tells of what is missing, of another type or
 * not known, by file and JSON pointer. */
class JsonObject {
public:
  using Json = nlohmann::ordered_json;

  /** \param[in] file, json are kept by reference \param[in] pointer place in the file
   * \throws IoFailed json is no object */
  JsonObject(const std::filesystem::path& file, const Json& json, std::string pointer);

  bool
  has(const std::string& key) const
  {
    return json_.contains(key);
  }

  /** \brief Reads a number, if it is there. \throws IoFailed it is something else */
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

  /** \brief Reads what must be there. */
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

  /** \brief Calls f with each element of an array, which may be missing, and with its
   * place. */
  void
  each(const std::string& key,
       const std::function<void(const Json&, const std::string&)>& f);

  /** \brief Calls f with each object of an array, which may be missing, and makes sure
   * that f knows all its keys. */
  void
  eachObject(const std::string& key, const std::function<void(JsonObject&)>& f);

  /** \return the object, or an empty one if it is missing */
  JsonObject
  object(const std::string& key);

  /** \return all keys */
  std::vector<std::string>
  keys() const;

  /** \throws IoFailed a key was never read */
  void
  finish() const;

  /** \throws IoFailed the key is missing */
  void
  require(const std::string& key) const;

  /** \throws IoFailed "file: /pointer/key: message" */
  [[noreturn]] void
  fail(const std::string& key, const std::string& message) const;

  const std::filesystem::path&
  file() const
  {
    return file_;
  }

private:
  const Json*
  find(const std::string& key);

  const std::filesystem::path& file_;
  const Json& json_;
  std::string pointer_;
  std::set<std::string> read_;
};

/** \return the numbers of a JSON array \throws IoFailed it holds something else */
std::vector<double>
jsonNumbers(const std::filesystem::path& file,
            const JsonObject::Json& json,
            const std::string& pointer);

/** \return the content of a JSON file \throws IoFailed naming file and line */
JsonObject::Json
readJson(const std::filesystem::path& file);

} // namespace pcl6d
