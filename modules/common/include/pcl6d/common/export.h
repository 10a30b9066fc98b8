// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#if __cplusplus < 201703L
#error "PCL6D needs C++17: compile with -std=c++17 or later"
#endif

/** \file Symbol visibility of the libraries. The libraries are built with hidden visibility. A
 * public header opens the namespace as `namespace PCL6D_EXPORTS pcl6d {`, and only declarations
 * in such a block can be linked against. Internals of a module live in a separate namespace
 * (`pcl6d::search`), without the mark. */
#define PCL6D_EXPORTS [[gnu::visibility("default")]]
