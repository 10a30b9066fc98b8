// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include <cstddef>
#include <string>

/** \file Formatting of numbers in the doctor's reports. */
namespace pcl6d::app {

/** \return the value with a number of significant digits: "0.0123" */
std::string
shortNumber(double value, int digits = 3);

/** \return "0.0123 m" */
std::string
metres(double value);

/** \return "3 %" of 0.03 */
std::string
percentText(double share);

/** \return "12 of 397 (3 %)" */
std::string
shareText(std::size_t part, std::size_t whole);

/** \return "0.012 m, 3.4 deg" */
std::string
motionText(double translation, double rotation);

/** \return the three numbers with the digits needed: "450000, 5950000, 120" */
std::string
vectorText(const Eigen::Vector3d& v);

/** \return the text of a position: millimetres, or four digits: "450000.125, 0.03406,
 * 120.05" */
std::string
placeText(const Eigen::Vector3d& v);

} // namespace pcl6d::app
