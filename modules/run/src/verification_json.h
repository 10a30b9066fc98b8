// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/map_verification.h>
#include <pcl6d/io/json_object.h>

#include <nlohmann/json_fwd.hpp>

/** \file The verdict of a verification in JSON, the same in every file that holds it. */
namespace pcl6d::run_files {

/** \return all but the links, which stand in a table of their own */
nlohmann::ordered_json
jsonOfVerification(const MapVerification& map);

/** \brief Inverse of jsonOfVerification().
 * \throws IoFailed naming file and place: what is missing, of another type or out of its
 * range, no such word */
MapVerification
verificationFrom(const JsonValue& json);

} // namespace pcl6d::run_files
