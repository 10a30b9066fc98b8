// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/map_verification.h>

#include <nlohmann/json_fwd.hpp>

/** \file The verdict of a verification in JSON, the same in every file that holds it. */
namespace pcl6d::run_files {

/** \return all but the links, which stand in a table of their own */
nlohmann::ordered_json
jsonOfVerification(const MapVerification& map);

/** \brief Inverse of jsonOfVerification(). \throws the JSON library's, or BadArgument:
 * what is missing or no such word */
MapVerification
verificationFrom(const nlohmann::ordered_json& json);

} // namespace pcl6d::run_files
