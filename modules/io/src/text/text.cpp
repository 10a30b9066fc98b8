// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/io/text.h>

#include <cerrno>
#include <cstring>
#include <istream>
#include <sys/stat.h>

namespace pcl6d::text {

namespace {
constexpr std::size_t kReadBlock = 1 << 20; // bytes read at once
constexpr std::size_t kLongestQuote = 40;

namespace fs = std::filesystem;

/** \return whether the path names an open descriptor of a process */
bool
namesDescriptor(const fs::path& path)
{
  const std::string name = path.lexically_normal().string();
  if (name == "/dev/stdin")
    return true;
  const auto numbered = [&name](const std::string& folder) {
    return name.rfind(folder, 0) == 0 && name.size() > folder.size() &&
           name.find_first_not_of("0123456789", folder.size()) == std::string::npos;
  };
  return numbered("/dev/fd/") || numbered("/proc/self/fd/");
}

/** \return the kind of a path that is not a regular file, in words; else null */
const char*
kindOf(mode_t mode)
{
  if (S_ISFIFO(mode))
    return "a pipe";
  if (S_ISSOCK(mode))
    return "a socket";
  return S_ISCHR(mode) || S_ISBLK(mode) ? "a device" : nullptr;
}

/** Fails if the path is unreadable, or reading would wait for another process. */
void
requireFile(const fs::path& path)
{
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) {
    const std::string reason =
        errno == ENOENT ? "which is not there" : systemReason("cannot be opened");
    const std::string plain = systemReason("cannot be opened");
    std::error_code error;
    const fs::path target = fs::read_symlink(path, error);
    if (error)
      fail(path, plain);
    fail(path, "is a link to '" + target.string() + "', " + reason);
  }
  const char* const kind = kindOf(found.st_mode);
  if (kind && !namesDescriptor(path))
    fail(path, std::string("is ") + kind + ", but must be a file");
}
} // namespace

std::ifstream
open(const std::filesystem::path& path)
{
  requireFile(path);
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (stream)
    stream.peek(); // a folder can be opened, but not read
  if (!stream && !stream.eof())
    fail(path, systemReason("cannot be opened"));
  stream.clear();
  return stream;
}

bool
isThere(const std::filesystem::path& path)
{
  struct stat found {};
  return ::lstat(path.c_str(), &found) == 0 || (errno != ENOENT && errno != ENOTDIR);
}

std::string
readRest(std::istream& stream, const std::filesystem::path& path)
{
  errno = 0;
  std::string content;
  while (stream) { // block by block, since the size of a pipe is unknown
    const std::size_t size = content.size();
    content.resize(size + kReadBlock);
    stream.read(content.data() + size, kReadBlock);
    content.resize(size + static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad())
    fail(path, systemReason("cannot be read"));
  return content;
}

std::string
readFile(const std::filesystem::path& path)
{
  std::ifstream stream = open(path);
  return readRest(stream, path);
}

void
fail(const std::filesystem::path& path, const std::string& message)
{
  throw IoFailed(path.string() + ": " + message);
}

void
failAt(const std::filesystem::path& path, std::size_t line, const std::string& message)
{
  fail(path, "line " + std::to_string(line) + ": " + message);
}

std::string
systemReason(const char* otherwise)
{
  return errno ? std::strerror(errno) : otherwise;
}

std::string
quoted(std::string_view token)
{
  std::string shown = "'";
  for (const char c : token.substr(0, kLongestQuote))
    shown += c >= ' ' && c <= '~' ? c : '?';
  return shown + (token.size() > kLongestQuote ? "...'" : "'");
}

std::string
counted(std::size_t count, const std::string& noun)
{
  return std::to_string(count) + ' ' + noun + (count == 1 ? "" : "s");
}

bool
isBlank(std::string_view line)
{
  return Tokens(line).next().empty();
}

void
readRow(const std::filesystem::path& path, const Lines& lines, std::vector<double>& row)
{
  row.clear();
  Tokens tokens(lines.line());
  for (auto token = tokens.next(); !token.empty(); token = tokens.next()) {
    double value = 0;
    if (!parseNumber(token, value))
      failAt(path, lines.number(), quoted(token) + " is not a number");
    row.push_back(value);
  }
}

} // namespace pcl6d::text
