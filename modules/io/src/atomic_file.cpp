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

constexpr int kMostTries = 100; // of names; one of 2^60 is taken by somebody else

/** \return a hidden name that nobody can foresee. It is not made from the target's, which
 * may already have the greatest length. */
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

/** \return the number of the open file of this process that a path names, such as
 * /dev/stdout; -1: it names none */
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

/** \return whether a link was made by somebody else, who would choose what is replaced */
bool
isLinkOfAnother(const fs::path& path)
{
  struct stat found {};
  return ::lstat(path.c_str(), &found) == 0 && S_ISLNK(found.st_mode) &&
         found.st_uid != ::geteuid() && found.st_uid != 0;
}

/** \brief What is to be written, and what is there. */
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
  if (open_file >= 0) { // a file there was opened by who started this process
    is_special = true;
    return;
  }
  if (isLinkOfAnother(asked))
    text::fail(asked, "is a link of another user, which is not followed");
  std::error_code error;
  if (fs::is_symlink(asked, error)) { // a link stays a link
    const fs::path behind = fs::canonical(asked, error);
    path = error ? asked : behind;
  }
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0)
    return;
  if (S_ISDIR(found.st_mode))
    text::fail(asked, "cannot be written: it is a folder");
  is_special = !S_ISREG(found.st_mode);
  mode = found.st_mode & 0777;
}

/** \brief Calls make with random names in the folder of the target until one is free.
 * \return that name; what make returns must be an error of errno or 0 */
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

/** Gives a complete file the permissions of the one that it replaces, and waits until the
 * disk has it. Not all file systems know permissions or can be waited for. */
void
finish(int file, const Target& target)
{
  if (target.mode && ::fchmod(file, *target.mode) != 0 && errno != EPERM)
    target.fail(errno);
  if (::fsync(file) != 0 && errno != EINVAL && errno != ENOTSUP)
    target.fail(errno);
}

/** \brief Takes a name away at the end of its scope, with all that is below it. */
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

  fs::path path; ///< empty: nothing is there
};

/** \brief A file that is written and takes the place of the target when it is complete. */
class UnfinishedFile {
public:
  explicit UnfinishedFile(const Target& target) : target_(target)
  {
    // Without a name, it ends with the process whatever happens to that. It is given one
    // by its number in /proc.
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
  /** \return the permissions while it is written: the system takes off what the user does
   * not want for new files; those of the file that is replaced come when it is complete */
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

/** Makes a file that a library wrote by its name ready to be moved to its place. */
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
    const UnfinishedFile tried(target); // which goes as it came
}

} // namespace pcl6d
