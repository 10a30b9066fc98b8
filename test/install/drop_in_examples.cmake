# SPDX-License-Identifier: BSD-3-Clause
# The examples that make their own data; they exit with 1 if their result is wrong.
include(${SETTINGS})
run(COMMAND ${work}/examples_build/drop_in_icp
  PRINTS "pcl6d::ICP6D ok 0.1375 m 0.0549 rad" "all three found the true motion")
run(COMMAND ${work}/examples_build/search_drop_in PRINTS "5000 normals")
