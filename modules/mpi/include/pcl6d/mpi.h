// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module mpi. Processes on several machines that share the work
 * of a run. The module exists only where MPI was found by CMake. */
#include <pcl6d/mpi/mpi_sharing.h>
