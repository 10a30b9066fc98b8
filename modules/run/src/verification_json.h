// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "schema_keys.h"

#include <pcl6d/common/map_verification.h>
#include <pcl6d/io/json_object.h>

#include <nlohmann/json_fwd.hpp>

/** \file The verdict of a verification in JSON, equal in every file. */
namespace pcl6d::run_files {

/** \return the verdict without its links, which are written to a separate table */
nlohmann::ordered_json
jsonOfVerification(const MapVerification& map);

/** \brief Inverse of jsonOfVerification(). \param[in] keys of the version of the file
 * \throws IoFailed naming file and entry: missing, of another type or out of range, an unknown
 * word */
MapVerification
verificationFrom(const JsonValue& json, const SchemaKeys& keys);

} // namespace pcl6d::run_files
