// SPDX-License-Identifier: BSD-3-Clause
#include "e57/e57_scan_encoder.h"

#include <pcl6d/io/atomic_file.h>
#include <pcl6d/sources/e57_writer.h>

namespace pcl6d {

using namespace sources;

std::vector<std::vector<std::string>>
writeE57(const std::filesystem::path& path,
         std::size_t count,
         const std::function<E57Station(std::size_t)>& station,
         const std::string& coordinate_system)
{
  std::vector<std::vector<std::string>> losses;
  // The header is the first part of the file and the last known, so writing needs a seekable
  // file by name.
  writeFileAtomicallyBy(path, [&](const std::filesystem::path& file) {
    PageWriter pages(file);
    std::vector<WrittenScan> scans;
    for (std::size_t i = 0; i < count; ++i) {
      scans.push_back(encodeStation(station(i), pages));
      losses.push_back(scans.back().losses);
    }
    pages.align();
    const std::uint64_t offset = pages.physical();
    const std::string text = e57Text(scans, coordinate_system);
    pages.write(text.data(), text.size());
    pages.finish(offset, text.size());
  });
  return losses;
}

} // namespace pcl6d
