// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/fruit/core.h>
#include <pcl6d/fruit/pear.h>
