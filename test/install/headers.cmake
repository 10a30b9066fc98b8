# SPDX-License-Identifier: BSD-3-Clause
# Every installed header compiles on its own, with no more than its own module's target, and
# gives no warning to those who ask for many.
include(${SETTINGS})
configure(${here}/headers ${work}/headers
  FLAGS "-Wall -Wextra -Wconversion -Wdouble-promotion -Werror")
build(${work}/headers)
