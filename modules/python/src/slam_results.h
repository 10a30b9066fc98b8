// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/map_verification.h>
#include <pcl6d/common/run_result.h>
#include <pcl6d/slam6d/slam6d_options.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <Eigen/Core>

#include <map>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

namespace pcl6d::python {

/** \brief The options of Slam6D from keyword arguments: names of pcl_slam6d, with underscores
 * ("max_distance").
 * \throws BadArgument unknown option, another type, or a value out of range */
Slam6DOptions
slamOptions(const pybind11::dict& values);

/** \brief Names and values of options in words, usable without Python's lock. */
using OptionWords = std::map<std::string, std::string>;

/** \return the given options that are not None */
OptionWords
wordsOf(const pybind11::dict& values);

/** \return options and derived values for a summary */
std::vector<RunResult::Option>
usedOptions(const OptionWords& given, const Slam6DParameters& used);

/** \return the result of a scan \param[in] offset [m] subtracted from the scan's points */
pybind11::dict
scanDict(const ScanResult& scan,
         const Eigen::Vector3d& offset = Eigen::Vector3d::Zero());

/** \return the verdict on a map, or None */
pybind11::object
verificationOrNone(const std::optional<MapVerification>& map);

} // namespace pcl6d::python
