// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace pcl6d::test {

/** \return the folder of a recorded data set: $PCL6D_DATA/name or ../shared/data/name
 * beside the source tree; empty if it is not there */
std::filesystem::path
dataFolder(const std::string& name);

} // namespace pcl6d::test

/** Defines `folder` as the folder of a recorded data set or skips the test. */
#define PCL6D_DATA_OR_SKIP(folder, name)                                               \
  const std::filesystem::path folder = pcl6d::test::dataFolder(name);                  \
  if (folder.empty())                                                                  \
  GTEST_SKIP() << "recorded data " << name                                             \
               << " not found; set PCL6D_DATA to the folder that holds it"
