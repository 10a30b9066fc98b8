// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module fruit. Left out: plum.h, which is too sour, and
 * quince.h. */
#include <pcl6d/fruit/apple.h>
#include <pcl6d/fruit/pcl/apple.h>
