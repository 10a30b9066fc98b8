// SPDX-License-Identifier: BSD-3-Clause
#include "bindings.h"
#include "long_call.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/version.h>

#include <exception>
#include <filesystem>
#include <utility>

namespace pcl6d::python {

namespace {
void
raise(const char* type, const char* message)
{
  const py::object error = py::module_::import("pcl6d._errors").attr(type);
  PyErr_SetString(error.ptr(), message);
}

void
translate(std::exception_ptr thrown)
{
  try {
    std::rethrow_exception(std::move(thrown));
  } catch (const BadArgument& e) {
    raise("BadArgument", e.what());
  } catch (const ComputeFailed& e) {
    raise("ComputeFailed", e.what());
  } catch (const IoFailed& e) {
    raise("FileError", e.what());
  } catch (const std::filesystem::filesystem_error& e) {
    raise("FileError", e.what());
  } catch (const Interrupted&) {
    raise("ComputeFailed", "the call was stopped");
  }
}
} // namespace

} // namespace pcl6d::python

PYBIND11_MODULE(_native, module)
{
  using namespace pcl6d::python;
  py::register_exception_translator(&translate);
  module.attr("version") = PCL6D_VERSION;
  module.def("wait_for_stopped", &waitForStopped);
  bindEvaluation(module);
  bindFolderMapping(module);
  bindPlanes(module);
  bindPointTools(module);
  bindRegistration(module);
  bindRuns(module);
  bindScans(module);
  bindSlam(module);
  bindVerification(module);
}
