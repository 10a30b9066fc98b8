// SPDX-License-Identifier: BSD-3-Clause
#include "text/descriptor_stream.h"

#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/text.h>

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <optional>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

namespace pcl6d {

namespace fs = std::filesystem;
using io::Descriptor;
using io::DescriptorBuffer;

namespace {

constexpr int kMostTries = 100; // attempts; each name is one of 2^60

/** \return an unpredictable hidden name. The target's name is not part of it: the target may
 * already have the maximum length. */
std::string
hiddenName()
{
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz234567";
  unsigned char bytes[12];
  if (::getrandom(bytes, sizeof bytes, 0) != static_cast<ssize_t>(sizeof bytes))
    throw std::system_error(errno, std::generic_category(), "getrandom");
  std::string name = ".pcl6d-";
  for (const unsigned char byte : bytes)
    name += kLetters[byte % kLetters.size()];
  return name + "-tmp";
}

fs::path
folderOf(const fs::path& target)
{
  return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

/** \return the descriptor of this process behind a path such as /dev/stdout; -1: not a
 * descriptor */
int
openFileOf(const fs::path& path)
{
  if (path == "/dev/stdout")
    return STDOUT_FILENO;
  if (path == "/dev/stderr")
    return STDERR_FILENO;
  const fs::path folder = path.parent_path();
  const std::string name = path.filename();
  const bool is_number = !name.empty() && name.size() < 9 &&
                         name.find_first_not_of("0123456789") == std::string::npos;
  return is_number && (folder == "/dev/fd" || folder == "/proc/self/fd")
             ? std::stoi(name)
             : -1;
}

/** \return whether another user made the link and could thus choose the replaced file */
bool
isLinkOfAnother(const fs::path& path)
{
  struct stat found {};
  return ::lstat(path.c_str(), &found) == 0 && S_ISLNK(found.st_mode) &&
         found.st_uid != ::geteuid() && found.st_uid != 0;
}

/** \brief The file to write, resolved, with the state on disk. */
struct Target {
  fs::path asked; ///< for messages
  fs::path path;  ///< behind links
  std::optional<mode_t> mode;
  bool is_special = false; ///< a device, a pipe or an open file
  int open_file = -1;      ///< its number

  explicit Target(const fs::path& asked_path);

  [[noreturn]] void
  fail(int error) const
  {
    text::fail(asked, error ? std::strerror(error) : "cannot be written");
  }
};

Target::Target(const fs::path& asked_path) : asked(asked_path), path(asked_path)
{
  if (asked.empty() || asked.filename().empty())
    text::fail(asked, "is not the name of a file");
  open_file = openFileOf(asked);
  if (open_file >= 0) { // opened by the parent process
    is_special = true;
    return;
  }
  if (isLinkOfAnother(asked))
    text::fail(asked, "is a symbolic link of another user: not followed");
  std::error_code error;
  if (fs::is_symlink(asked, error)) { // a link stays a link
    const fs::path behind = fs::canonical(asked, error);
    path = error ? asked : behind;
  }
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0)
    return;
  if (S_ISDIR(found.st_mode))
    text::fail(asked, "cannot be written: is a folder");
  is_special = !S_ISREG(found.st_mode);
  mode = found.st_mode & 0777;
}

/** \brief Calls make with random names in the folder of the target until a name is free.
 * \return the name; make returns an errno or 0 */
template <typename Make>
fs::path
makeHidden(const Target& target, const Make& make)
{
  int error = EEXIST;
  for (int i = 0; i < kMostTries && error == EEXIST; ++i) {
    fs::path path = folderOf(target.path) / hiddenName();
    error = make(path);
    if (error == 0)
      return path;
  }
  target.fail(error);
}

/** Copies the permissions of the replaced file to a complete file, and flushes the file to the
 * disk. Not all file systems support permissions or flushing. */
void
finish(int file, const Target& target)
{
  if (target.mode && ::fchmod(file, *target.mode) != 0 && errno != EPERM)
    target.fail(errno);
  if (::fsync(file) != 0 && errno != EINVAL && errno != ENOTSUP)
    target.fail(errno);
}

/** \brief Removes a path, with everything below, at the end of the scope. */
class HiddenPath {
public:
  HiddenPath() = default;
  ~HiddenPath()
  {
    std::error_code ignored;
    if (!path.empty())
      fs::remove_all(path, ignored); // never follows a link
  }
  HiddenPath(const HiddenPath&) = delete;
  HiddenPath&
  operator=(const HiddenPath&) = delete;

  fs::path path; ///< empty: no file to remove
};

/** \brief A file under construction, which replaces the target when complete. */
class UnfinishedFile {
public:
  explicit UnfinishedFile(const Target& target) : target_(target)
  {
    // Without a name, the file vanishes with the process in any case. The name is given at the
    // end, through the descriptor in /proc.
    if (::access("/proc/self/fd", X_OK) == 0)
      file_ = Descriptor(::open(
          folderOf(target.path).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, mode()));
    if (file_.isOpen())
      return;
    hidden_.path = makeHidden(target, [&](const fs::path& path) {
      constexpr int kNew = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
      file_ = Descriptor(::open(path.c_str(), kNew, mode()));
      return file_.isOpen() ? 0 : errno;
    });
  }

  int
  number() const
  {
    return file_.number();
  }

  void
  publish()
  {
    finish(number(), target_);
    if (hidden_.path.empty() && !target_.mode && linkAs(target_.path) == 0)
      return;
    if (hidden_.path.empty())
      hidden_.path =
          makeHidden(target_, [&](const fs::path& path) { return linkAs(path); });
    if (!file_.close() || ::rename(hidden_.path.c_str(), target_.path.c_str()) != 0)
      target_.fail(errno);
    hidden_.path.clear();
  }

private:
  /** \return the permissions during writing: the system applies the user's umask for new files;
   * the permissions of a replaced file are copied at the end */
  mode_t
  mode() const
  {
    return target_.mode ? 0600 : 0666;
  }

  /** \return 0, or an errno */
  int
  linkAs(const fs::path& path) const
  {
    const std::string self = "/proc/self/fd/" + std::to_string(number());
    return ::linkat(
               AT_FDCWD, self.c_str(), AT_FDCWD, path.c_str(), AT_SYMLINK_FOLLOW) == 0
               ? 0
               : errno;
  }

  const Target& target_;
  HiddenPath hidden_;
  Descriptor file_;
};

/** \return the device, pipe or open file of a target, ready to be written */
Descriptor
opened(const Target& target)
{
  Descriptor file(target.open_file >= 0
                      ? ::fcntl(target.open_file, F_DUPFD_CLOEXEC, 0)
                      : ::open(target.path.c_str(), O_WRONLY | O_CLOEXEC));
  if (!file.isOpen())
    target.fail(errno);
  return file;
}

/** Writes to an open file. */
void
writeTo(int file, const Target& target, const std::function<void(std::ostream&)>& write)
{
  DescriptorBuffer buffer(file);
  std::ostream stream(&buffer);
  write(stream);
  stream.flush();
  if (!stream)
    target.fail(buffer.error());
}

/** Prepares a file written by a library for the move to the target. */
void
complete(const Target& target, const fs::path& written)
{
  const Descriptor file(::open(written.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC));
  if (!file.isOpen())
    target.fail(errno);
  finish(file.number(), target);
}

} // namespace

void
writeFileAtomically(const fs::path& path,
                    const std::function<void(std::ostream&)>& write)
{
  const Target target(path);
  if (target.is_special) { // must not be replaced
    Descriptor file = opened(target);
    writeTo(file.number(), target, write);
    if (!file.close())
      target.fail(errno);
    return;
  }
  UnfinishedFile file(target);
  writeTo(file.number(), target, write);
  file.publish();
}

void
writeFileAtomicallyBy(const fs::path& path,
                      const std::function<void(const fs::path&)>& write)
{
  const Target target(path);
  if (target.is_special)
    return write(target.path);
  HiddenPath folder;
  folder.path = makeHidden(target, [](const fs::path& name) {
    return ::mkdir(name.c_str(), 0700) == 0 ? 0 : errno;
  });
  fs::path written = folder.path / "content";
  written += target.path.extension();
  write(written);
  complete(target, written);
  if (::rename(written.c_str(), target.path.c_str()) != 0)
    target.fail(errno);
}

bool
isStream(const fs::path& path)
{
  return Target(path).is_special;
}

void
requireWritable(const fs::path& path)
{
  const Target target(path);
  if (!target.is_special)
    const UnfinishedFile tried(target); // vanishes at the end of the scope
}

} // namespace pcl6d
