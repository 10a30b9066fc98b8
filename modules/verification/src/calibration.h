// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file The constants of verification and where each comes from. */
namespace pcl6d::verification {

/** A scan whose rays contradict a larger share of its own points abstains. */
constexpr double kAbstainingShare = 0.02;

} // namespace pcl6d::verification
