// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#if __cplusplus < 201703L
#error "PCL6D needs C++17: compile with -std=c++17 or later"
#endif

/** \file
 * What the libraries of the suite show. They are built with hidden visibility; a public
 * header opens its namespace as `namespace PCL6D_EXPORTS pcl6d {`, so that what it
 * declares, and nothing else, can be linked against. The internals of a module live in a
 * namespace of its own (`pcl6d::search`), whose blocks carry no such mark. */
#define PCL6D_EXPORTS [[gnu::visibility("default")]]
