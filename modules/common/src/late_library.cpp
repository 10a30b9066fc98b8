// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/late_library.h>

#include <dlfcn.h>
#include <filesystem>

namespace pcl6d {

namespace fs = std::filesystem;

namespace {
/** \return the folder of the library around this function; empty: not known. The loader would
 * search the run path of the library that calls dlopen(), which may be a sanitizer. */
fs::path
folderOfSuite()
{
  Dl_info info{};
  if (::dladdr(reinterpret_cast<void*>(&symbolOfLateLibrary), &info) == 0 ||
      !info.dli_fname)
    return {};
  return fs::path(info.dli_fname).parent_path();
}

[[noreturn]] void
failAsLoader(const std::string& begin)
{
  const char* said = ::dlerror();
  throw IoFailed(begin + (said ? said : "unknown reason"));
}
} // namespace

void*
symbolOfLateLibrary(const std::string& purpose,
                    const std::string& library,
                    const char* symbol)
{
  constexpr int kMode = RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE;
  const std::string file = "lib" + library + ".so";
  const fs::path beside = folderOfSuite() / file;
  std::error_code error;
  void* opened = nullptr;
  if (fs::exists(beside, error)) {
    opened = ::dlopen(beside.c_str(), kMode);
    if (!opened)
      failAsLoader(purpose + ": cannot be opened: ");
  }
  else {
    opened = ::dlopen(file.c_str(), kMode);
    if (!opened)
      throw IoFailed(purpose + ": the library " + beside.string() +
                     " is missing; cmake --build build/release --target " + library +
                     " builds it");
  }
  void* const address = ::dlsym(opened, symbol);
  if (!address)
    failAsLoader(purpose + ": the library " + file + " is of another version: ");
  return address;
}

} // namespace pcl6d
