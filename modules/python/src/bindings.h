// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

/** \file The functions of the extension module pcl6d._native, by topic. Only the
 * package calls these functions. */
namespace pcl6d::python {

void
bindEvaluation(pybind11::module_& module);
void
bindFolderMapping(pybind11::module_& module);
void
bindPlanes(pybind11::module_& module);
void
bindPointTools(pybind11::module_& module);
void
bindRegistration(pybind11::module_& module);
void
bindRuns(pybind11::module_& module);
void
bindScans(pybind11::module_& module);
void
bindSlam(pybind11::module_& module);
void
bindVerification(pybind11::module_& module);

} // namespace pcl6d::python
