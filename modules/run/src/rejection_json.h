// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/rejection.h>
#include <pcl6d/io/json_object.h>

#include <nlohmann/json_fwd.hpp>

#include <vector>

/** \file Rejections in summary.json: reason, numbers and cause. */
namespace pcl6d::run_files {

nlohmann::ordered_json
jsonOfRejection(const Rejection& rejection);
nlohmann::ordered_json
jsonOfRejections(const std::vector<Rejection>& rejections);

/** \brief Inverse of jsonOfRejection().
 * \throws IoFailed naming file and position: a value is missing or of another type, the reason is
 * not known, or causes are nested too deeply */
Rejection
rejectionFrom(const JsonValue& json);
/** \brief Inverse of jsonOfRejections(). */
std::vector<Rejection>
rejectionsFrom(const JsonValue& json);

} // namespace pcl6d::run_files
