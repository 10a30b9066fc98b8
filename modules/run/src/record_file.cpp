// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/io/text.h>
#include <pcl6d/run/record_file.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <zlib.h>

namespace pcl6d {

namespace {
constexpr char kMagic[] = "pcl6d records 1\n"; ///< the number is the version
constexpr std::size_t kMagicSize = sizeof kMagic - 1;

/** Header of a record. */
struct Head {
  std::uint64_t size;
  std::uint64_t checksum; ///< CRC-32 of the size and the record
};

std::uint32_t
checksumOf(std::uint64_t size, const char* record)
{
  const auto bytes = [](const void* data) {
    return static_cast<const unsigned char*>(data);
  };
  const auto crc = ::crc32_z(0, bytes(&size), sizeof size);
  return static_cast<std::uint32_t>(::crc32_z(crc, bytes(record), size));
}

[[noreturn]] void
failWithErrno(const std::filesystem::path& path, const std::string& what)
{
  throw IoFailed(path.string() + ": " + what + ": " + std::strerror(errno));
}

/** \return false if writing failed, with the reason in errno */
bool
writeAll(int file, const std::string& bytes)
{
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = ::write(file, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR)
      continue;
    if (count <= 0)
      return false;
    done += static_cast<std::size_t>(count);
  }
  return true;
}

/** Syncs the folder: only then does a new file survive a power cut. */
void
syncFolder(const std::filesystem::path& file)
{
  const auto folder = std::filesystem::absolute(file).parent_path();
  const int handle = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (handle < 0)
    return;
  ::fsync(handle);
  ::close(handle);
}
} // namespace

RecordFile::RecordFile(const std::filesystem::path& path) : path_(path)
{
  // Links are not followed: the target is no journal of this program.
  file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0644);
  if (file_ < 0 && errno == ELOOP)
    throw IoFailed(path.string() + ": is a symbolic link: not followed");
  if (file_ < 0)
    failWithErrno(path, "cannot be opened");
  try {
    // Locks are not supported by every file system.
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      throw IoFailed(path.string() + ": another process is writing this file");
    const std::string content = text::readFile(path);
    const std::string head = content.substr(0, kMagicSize);
    if (head != std::string(kMagic).substr(0, head.size()))
      throw IoFailed(path.string() + ": is no file of records of this version");
    if (head.size() == kMagicSize)
      size_ = readRecords(content);
    dropped_ = content.size() - size_;
    if (::ftruncate(file_, static_cast<off_t>(size_)) != 0 ||
        ::lseek(file_, 0, SEEK_END) < 0)
      failWithErrno(path, "cannot be written");
    if (size_ == 0) {
      dropped_ = 0; // a part of the first line at most
      if (!writeAll(file_, kMagic))
        failWithErrno(path, "cannot be written");
      size_ = kMagicSize;
      syncFolder(path);
    }
  } catch (...) {
    ::close(file_);
    throw;
  }
}

RecordFile::~RecordFile()
{
  if (file_ >= 0)
    ::close(file_);
}

/** \return [bytes] up to the first incomplete or damaged record */
std::size_t
RecordFile::readRecords(const std::string& content)
{
  std::size_t place = kMagicSize;
  Head head{};
  while (content.size() - place >= sizeof head) {
    std::memcpy(&head, content.data() + place, sizeof head);
    const std::size_t begin = place + sizeof head;
    if (head.size > content.size() - begin ||
        head.checksum != checksumOf(head.size, content.data() + begin))
      break;
    records_.push_back(content.substr(begin, head.size));
    place = begin + head.size;
  }
  return place;
}

void
RecordFile::append(const std::string& record)
{
  if (file_ < 0)
    throw BadArgument(path_.string() + ": was removed");
  const Head head{record.size(), checksumOf(record.size(), record.data())};
  std::string bytes(sizeof head, '\0');
  std::memcpy(bytes.data(), &head, sizeof head);
  bytes += record;
  if (!writeAll(file_, bytes)) {
    const int error = errno;
    if (::ftruncate(file_, static_cast<off_t>(size_)) == 0)
      ::lseek(file_, 0, SEEK_END);
    errno = error;
    failWithErrno(path_, "cannot be written");
  }
  size_ += bytes.size();
  ::fdatasync(file_);
}

void
RecordFile::remove()
{
  if (file_ < 0)
    return;
  std::error_code ignored; // gone already
  std::filesystem::remove(path_, ignored);
  ::close(file_);
  file_ = -1;
}

} // namespace pcl6d
