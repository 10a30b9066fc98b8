// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/sources/bag.h>

#include <memory>

/** \file The recordings of ROS 2: databases, and folders of several files. */
namespace pcl6d::sources {

/** \brief Whether each message is compressed for itself. */
enum class MessageCompression { kNone, kZstd };

/** \brief Opens a db3 database of ROS 2, or a compressed database (.zstd) through an
 * uncompressed temporary copy. \throws IoFailed under the conditions of openBag() */
std::shared_ptr<const Bag>
openBagDatabase(const std::filesystem::path& path, MessageCompression compression);

/** \brief Opens the files listed in the metadata.yaml of a folder, as a single recording.
 * \throws IoFailed under the conditions of openBag(), or if a file is missing */
std::shared_ptr<const Bag>
openBagFolder(const std::filesystem::path& folder);

} // namespace pcl6d::sources
