// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include <exception>
#include <filesystem>
#include <string>

/** \file Writing of JSON, and matrices in JSON. */
namespace PCL6D_EXPORTS pcl6d {

/** \return the numbers of a matrix or vector, row by row */
nlohmann::ordered_json
rowByRow(const Eigen::Ref<const Eigen::MatrixXd>& matrix);

/** \brief Takes the numbers of a matrix or vector, row by row. \param[in] name for messages
 * \throws std::invalid_argument the number of values differs from the size of the matrix */
void
fill(const nlohmann::ordered_json& json,
     const std::string& name,
     Eigen::Ref<Eigen::MatrixXd> matrix);

/** \return the message of the JSON library without the bracketed error number */
std::string
reasonOf(const std::exception& error);

/** \return the text of a file, with a line end; invalid UTF-8 is replaced
 * \param[in] indent of each level */
std::string
jsonFileText(const nlohmann::ordered_json& json, int indent = 1);

/** \brief Writes the text of a file atomically. \throws IoFailed the file cannot be written */
void
writeJson(const std::filesystem::path& path,
          const nlohmann::ordered_json& json,
          int indent = 1);

} // namespace pcl6d
