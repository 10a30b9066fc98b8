// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/json_object.h>

#include <string>

/** \file Names of keys and columns in the files of runs of former schema versions. */
namespace pcl6d::run_files {

constexpr int kFirstSchema = 1; ///< oldest schema_version that is read

/** \return the name of a key or column in files of schema_version 1 */
std::string
nameInFirstSchema(const std::string& name);

/** \brief Finds the name of a key in a file by the schema_version of the file. */
class SchemaKeys {
public:
  explicit SchemaKeys(int version) : version_(version) {}

  /** \param[in] name of the key in the current version \return its name in the file */
  std::string
  operator()(const std::string& name) const
  {
    return version_ == kFirstSchema ? nameInFirstSchema(name) : name;
  }

private:
  int version_;
};

/** \return the keys of a file by its `schema_version` \throws IoFailed an unknown version */
SchemaKeys
keysOf(const JsonValue& schema_version);

} // namespace pcl6d::run_files
