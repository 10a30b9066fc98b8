# SPDX-License-Identifier: BSD-3-Clause
# A consumer that was written for the last version: its components, its header paths.
include(${SETTINGS})
configure(${here}/former_version ${work}/former_version)
build(${work}/former_version)
run(COMMAND ${work}/former_version/consumer PRINTS "^ICP ok, 3 rays, RunSummary")
