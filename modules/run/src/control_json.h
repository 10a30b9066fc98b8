// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/control_points.h>
#include <pcl6d/io/json_object.h>

#include <nlohmann/json_fwd.hpp>

/** \file The adjustment to control points in summary.json. */
namespace pcl6d::run_files {

nlohmann::ordered_json
jsonOfControl(const ControlResult& control);

/** \brief Inverse of jsonOfControl(). \param[in] num_scans of the run
 * \throws IoFailed naming file and entry: missing, of another type or out of range */
ControlResult
controlFrom(const JsonValue& json, std::size_t num_scans);

} // namespace pcl6d::run_files
