// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module semantic_map. Rooms, planes and objects of a map, the
 * relations between them, and queries. */
#include <pcl6d/semantic_map/map_entity.h>
#include <pcl6d/semantic_map/map_query.h>
#include <pcl6d/semantic_map/point_labels.h>
#include <pcl6d/semantic_map/semantic_map.h>
#include <pcl6d/semantic_map/semantic_map_builder.h>
#include <pcl6d/semantic_map/semantic_map_io.h>
