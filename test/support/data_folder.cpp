// SPDX-License-Identifier: BSD-3-Clause
#include "support/data_folder.h"
#include "support/folders.h"

#include <cstdlib>

std::filesystem::path
pcl6d::test::dataFolder(const std::string& name)
{
  const char* root = std::getenv("PCL6D_DATA");
  const std::filesystem::path folder =
      (root ? std::filesystem::path(root)
            : std::filesystem::path(PCL6D_SOURCE_DIR).parent_path() / "shared/data") /
      name;
  return std::filesystem::is_directory(folder) ? folder : std::filesystem::path();
}
