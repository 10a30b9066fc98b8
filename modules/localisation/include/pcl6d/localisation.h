// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module localisation. Monte Carlo localisation of a robot in a
 * known plan, by virtual 2D scans cut from 3D scans. */
#include <pcl6d/localisation/levelling.h>
#include <pcl6d/localisation/monte_carlo_localisation.h>
#include <pcl6d/localisation/segment_map.h>
#include <pcl6d/localisation/virtual_scan.h>
