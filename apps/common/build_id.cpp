// SPDX-License-Identifier: BSD-3-Clause
#include "common/build_id.h"

#include <pcl6d/common/fingerprint.h>

#include <iomanip>
#include <link.h>
#include <sstream>
#include <string_view>
#include <sys/stat.h>

namespace pcl6d::app {

namespace {
void
addFile(const char* path, Fingerprint& sum)
{
  struct stat file {};
  if (::stat(path, &file) != 0)
    return;
  sum.add(static_cast<std::uint64_t>(file.st_size));
  sum.add(static_cast<std::uint64_t>(file.st_mtim.tv_sec));
  sum.add(static_cast<std::uint64_t>(file.st_mtim.tv_nsec));
}

int
addLibrary(dl_phdr_info* library, std::size_t, void* sum)
{
  if (std::string_view(library->dlpi_name).find("libpcl6d") != std::string_view::npos)
    addFile(library->dlpi_name, *static_cast<Fingerprint*>(sum));
  return 0;
}
} // namespace

std::string
buildId()
{
  Fingerprint sum;
  addFile("/proc/self/exe", sum);
  ::dl_iterate_phdr(addLibrary, &sum);
  std::ostringstream text;
  text << std::hex << std::setw(16) << std::setfill('0') << sum.value();
  return text.str();
}

} // namespace pcl6d::app
