// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/text.h>

#include <atomic>
#include <cerrno>
#include <fstream>
#include <unistd.h>

namespace pcl6d {

namespace fs = std::filesystem;

namespace {

/** \brief A temporary name beside the file that it will become. Removes what is there
 * at the end of its scope, unless it was renamed. */
class TemporaryFile {
public:
  explicit TemporaryFile(const fs::path& target) : target_(target)
  {
    static std::atomic<unsigned> counter{0};
    // Not made from the target's name, which may already have the greatest length.
    path_ = target.parent_path() / (".pcl6d-" + std::to_string(::getpid()) + '-' +
                                    std::to_string(counter++) + "-tmp");
    path_ += target.extension();
  }
  ~TemporaryFile()
  {
    std::error_code ignored;
    if (!renamed_)
      fs::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile&
  operator=(const TemporaryFile&) = delete;

  const fs::path&
  path() const
  {
    return path_;
  }

  /** \return the reason if it did not work */
  std::error_code
  rename()
  {
    std::error_code error;
    fs::rename(path_, target_, error);
    renamed_ = !error;
    return error;
  }

private:
  fs::path target_;
  fs::path path_;
  bool renamed_ = false;
};

/** Fails if no file can have this name, before the work that makes the content. */
void
checkTarget(const fs::path& path)
{
  std::error_code ignored;
  if (path.empty() || path.filename().empty())
    text::fail(path, "is not the name of a file");
  if (fs::is_directory(path, ignored))
    text::fail(path, "cannot be written: it is a folder");
}

} // namespace

void
writeFileAtomically(const fs::path& path,
                    const std::function<void(std::ostream&)>& write)
{
  writeFileAtomicallyBy(path, [&](const fs::path& temporary) {
    errno = 0;
    std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
    if (!stream)
      text::fail(path, text::systemReason("cannot be written"));
    errno = 0;
    write(stream);
    stream.close();
    if (!stream)
      text::fail(path, text::systemReason("cannot be written"));
  });
}

void
writeFileAtomicallyBy(const fs::path& path,
                      const std::function<void(const fs::path&)>& write)
{
  checkTarget(path);
  std::error_code error;
  // A link stays a link: the file that it names is replaced.
  fs::path target = fs::is_symlink(path, error) ? fs::canonical(path, error) : path;
  if (error)
    target = path;
  if (fs::exists(target, error) && !fs::is_regular_file(target, error))
    return write(target); // a device or pipe must not be replaced
  TemporaryFile temporary(target);
  write(temporary.path());
  error = temporary.rename();
  if (error)
    text::fail(path, error.message());
}

} // namespace pcl6d
