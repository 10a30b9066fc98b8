// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <optional>
#include <string>

/** \file Writing of JSON; json_object.h reads it. */
namespace PCL6D_EXPORTS pcl6d {

/** \return the numbers of a matrix or vector, row by row */
nlohmann::ordered_json
rowByRow(const Eigen::Ref<const Eigen::MatrixXd>& matrix);

/** \return the number; null if it is not finite, because JSON has no NaN and no infinity */
nlohmann::ordered_json
finiteOrNull(double value);

/** \return the number; null if it is missing */
nlohmann::ordered_json
numberOrNull(const std::optional<double>& value);

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
