# SPDX-License-Identifier: BSD-3-Clause
# Builds a copy of share/examples as its README tells.
include(${SETTINGS})
file(REMOVE_RECURSE ${work}/examples)
file(COPY ${source}/share/examples DESTINATION ${work})
# GCC 12 has false alarms in Eigen's code (array-bounds) when it optimises.
configure(${work}/examples ${work}/examples_build
  FLAGS "-Wall -Wextra -Wpedantic -Wshadow -Werror -Wno-array-bounds")
build(${work}/examples_build)
