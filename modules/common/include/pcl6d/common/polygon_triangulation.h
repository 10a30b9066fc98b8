// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file Kept for one version: include <pcl6d/common/polygon.h>. */
#include <pcl6d/common/polygon.h>
