// SPDX-License-Identifier: BSD-3-Clause
#include "e57/e57_scan_encoder.h"
#include "e57/page_writer.h"

#include <pcl6d/common/require.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/text.h>
#include <pcl6d/sources/e57_poses.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace pcl6d {

using namespace sources;

namespace {

namespace fs = std::filesystem;

/** \return the element of a pose, padded with blanks to the given minimum size */
std::string
poseTextOfSize(const Eigen::Isometry3d& pose, std::size_t size)
{
  std::string text = e57PoseText(pose);
  if (text.size() < size)
    text.insert(text.rfind("</pose>"), size - text.size(), ' ');
  return text;
}

/** \return the XML section with the new poses */
std::string
withPoses(const fs::path& path,
          const std::string& xml,
          const std::vector<E57Scan>& scans,
          const std::vector<std::optional<Eigen::Isometry3d>>& poses)
{
  std::string changed;
  std::uint64_t done = 0;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (!poses[i])
      continue;
    const auto [begin, end] = scans[i].pose_text;
    if (xml.compare(begin, 2, "<p") != 0) // <pose or <points
      text::fail(path, "the XML section is not UTF-8: no pose can be written");
    changed.append(xml, done, begin - done);
    changed += poseTextOfSize(*poses[i], end - begin);
    if (begin == end)
      changed += '\n';
    done = end;
  }
  return changed.append(xml, done, std::string::npos);
}

/** \brief Changes the content of an existing file, page by page. */
class PagePatch {
public:
  explicit PagePatch(const fs::path& path)
  : path_(path), stream_(path, std::ios::in | std::ios::out | std::ios::binary)
  {}

  /** \param[in] place logical; pages behind the end of the file are new */
  void
  write(std::uint64_t place, const void* data, std::size_t count)
  {
    const auto* bytes = static_cast<const std::uint8_t*>(data);
    while (count > 0) {
      const std::size_t within = place % kPageContent;
      const std::size_t part = std::min(count, kPageContent - within);
      const std::uint64_t begin = place / kPageContent * kPageSize;
      std::array<std::uint8_t, kPageSize> page{};
      stream_.seekg(static_cast<std::streamoff>(begin));
      stream_.read(reinterpret_cast<char*>(page.data()), page.size());
      stream_.clear();
      if (std::memcmp(&page[within], bytes, part) != 0 || !isComplete(page))
        put(begin, within, bytes, part, page);
      place += part;
      bytes += part;
      count -= part;
    }
  }

  void
  finish()
  {
    stream_.flush();
    if (!stream_)
      text::fail(path_, text::systemReason("cannot be written"));
  }

private:
  /** \return whether the page was in the file: a new page has no checksum yet */
  static bool
  isComplete(std::array<std::uint8_t, kPageSize> page)
  {
    const auto before = page;
    storeChecksum(page.data());
    return page == before;
  }

  void
  put(std::uint64_t begin,
      std::size_t within,
      const std::uint8_t* bytes,
      std::size_t part,
      std::array<std::uint8_t, kPageSize>& page)
  {
    std::memcpy(&page[within], bytes, part);
    storeChecksum(page.data());
    stream_.seekp(static_cast<std::streamoff>(begin));
    stream_.write(reinterpret_cast<const char*>(page.data()), page.size());
    if (!stream_)
      text::fail(path_, text::systemReason("cannot be written"));
  }

  fs::path path_;
  std::fstream stream_;
};

/** \return the header of the file for a new length of the XML section */
E57Header
headerFor(const PageReader& file, std::uint64_t begin, std::uint64_t xml_length)
{
  E57Header header = file.header();
  if (xml_length > header.xml_length) {
    const std::uint64_t end = begin + header.xml_length;
    const bool is_last =
        (end + kPageContent - 1) / kPageContent * kPageContent == file.size();
    if (!is_last) {
      header.xml_offset = header.length;
      begin = file.size();
    }
    const std::uint64_t pages = (begin + xml_length + kPageContent - 1) / kPageContent;
    header.length = pages * kPageSize;
  }
  header.xml_length = xml_length;
  return header;
}

} // namespace

void
writeE57Poses(const fs::path& from,
              const fs::path& to,
              const std::vector<std::optional<Eigen::Isometry3d>>& poses)
{
  PageReader file(from);
  const std::vector<E57Scan> scans = readE57Layout(file);
  require(poses.size() == scans.size(),
          "number of poses",
          poses.size(),
          "the number of scans of " + from.string() + ", " +
              std::to_string(scans.size()));
  const std::uint64_t begin =
      file.logicalOf(file.header().xml_offset, "the XML section");
  std::string xml(file.header().xml_length, '\0');
  file.read(begin, reinterpret_cast<std::uint8_t*>(xml.data()), xml.size());
  const std::string changed = withPoses(from, xml, scans, poses);
  const E57Header header = headerFor(file, begin, changed.size());
  writeFileAtomicallyBy(to, [&](const fs::path& copy) {
    fs::copy_file(from, copy);
    fs::permissions(copy, fs::perms::owner_write, fs::perm_options::add);
    PagePatch patch(copy);
    patch.write(header.xml_offset / kPageSize * kPageContent +
                    header.xml_offset % kPageSize,
                changed.data(),
                changed.size());
    std::array<std::uint8_t, 24> numbers{};
    storeLittleEndian(header.length, 8, &numbers[0]);
    storeLittleEndian(header.xml_offset, 8, &numbers[8]);
    storeLittleEndian(header.xml_length, 8, &numbers[16]);
    patch.write(16, numbers.data(), numbers.size());
    patch.finish();
  });
}

} // namespace pcl6d
