# SPDX-License-Identifier: BSD-3-Clause
# Every installed header compiles on its own, with no more than its own module's target.
include(${SETTINGS})
configure(${here}/headers ${work}/headers)
build(${work}/headers)
