// SPDX-License-Identifier: BSD-3-Clause
// Compiled as C++14, which the first header refuses.
#include <pcl6d/common/status.h>
