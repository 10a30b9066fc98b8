// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/folders.h"
#include "support/temp_folder.h"

#include <cstdlib>
#include <filesystem>
#include <string>

namespace pcl6d::test {

/** \brief While it lives, programs take libpcl6d_common from a folder of its own, beside
 * which there are none of the libraries that are opened late, as if they were not built. */
class WithoutLateLibraries {
public:
  WithoutLateLibraries()
  {
    const std::filesystem::path built = PCL6D_BUILD_DIR "/lib";
    for (const auto& file : std::filesystem::directory_iterator(built))
      if (file.path().filename().string().rfind("libpcl6d_common.so", 0) == 0)
        std::filesystem::copy_file(file, folder_ / file.path().filename().string());
    ::setenv("LD_LIBRARY_PATH", std::string(folder_ / "").c_str(), 1);
  }

  ~WithoutLateLibraries() { ::unsetenv("LD_LIBRARY_PATH"); }
  WithoutLateLibraries(const WithoutLateLibraries&) = delete;
  WithoutLateLibraries&
  operator=(const WithoutLateLibraries&) = delete;

  /** \return whether there are any: not where libraries are static */
  static bool
  areUsed()
  {
    return std::filesystem::exists(PCL6D_BUILD_DIR "/lib/libpcl6d_common.so");
  }

private:
  const TempFolder folder_;
};

} // namespace pcl6d::test
