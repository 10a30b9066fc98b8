// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/first_steps.h"
#include "common/options/option_words.h"
#include "common/printable.h"

#include <pcl6d/common/error.h>

#include <pcl/console/print.h>

#include <boost/program_options/errors.hpp>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <cxxabi.h>
#include <exception>
#include <fcntl.h>
#include <filesystem>
#include <iostream>
#include <locale>
#include <new>
#include <poll.h>
#include <string_view>
#include <system_error>
#include <typeinfo>
#include <unistd.h>

namespace pcl6d::app {

namespace {
/** \return the message without ": Success", the text of errno 0 */
std::string
sensible(std::string message)
{
  constexpr std::string_view kNoReason = ": Success"; // errno was 0
  for (auto at = message.find(kNoReason); at != std::string::npos;
       at = message.find(kNoReason))
    message.erase(at, kNoReason.size());
  return message;
}

/** \return the text of a file system error, in the order of all messages: the file, then the reason */
std::string
wordsOf(const std::filesystem::filesystem_error& error)
{
  std::string files = error.path1().string();
  if (!error.path2().empty())
    files += " or " + error.path2().string();
  return files.empty() ? std::string(error.what())
                       : files + ": " + error.code().message();
}

std::string
wordsOf(const std::bad_alloc& error)
{
  const std::string said = error.what();
  return said == "std::bad_alloc" || said == "std::bad_array_new_length"
             ? "not enough memory"
             : said;
}

int
report(const std::string& name, const std::string& message, ExitCode code)
{
  std::cerr << name << ": error: " << printable(sensible(message))
            << (code == kUsage ? " (see --help)\n" : "\n");
  return code;
}

/** std::locale("") throws for a locale in LANG or LC_* without installation, and libraries
 * call it deep in their work. This process and its children then get the locale "C". */
void
makeLocaleValid()
{
  try {
    std::locale("");
  } catch (const std::runtime_error&) {
    ::setenv("LC_ALL", "C", 1);
  }
}

const std::terminate_handler usual_end = std::get_terminate();

/** Whether an allocation of this thread has failed. */
thread_local bool lacked_memory = false;

void
rememberLack()
{
  lacked_memory = true;
  throw std::bad_alloc();
}

[[noreturn]] void
endWithoutMemory()
{
  ::dprintf(
      STDERR_FILENO, "%s: error: not enough memory\n", program_invocation_short_name);
  ::_exit(kFailed);
}

/** Memory may run out where runMain() cannot catch the exception: while main() builds its
 * arguments, in a thread of a library, or in a destructor. Inside a noexcept function the
 * handler cannot learn the type of the exception. The handler allocates no memory. */
void
endInWords()
try {
  if (const auto error = std::current_exception())
    std::rethrow_exception(error);
  if (lacked_memory && std::uncaught_exceptions() > 0)
    endWithoutMemory();
  usual_end();
} catch (const std::bad_alloc&) {
  endWithoutMemory();
} catch (...) {
  usual_end();
}

[[maybe_unused]] const std::terminate_handler replaced = std::set_terminate(endInWords);
[[maybe_unused]] const std::new_handler replaced_too =
    std::set_new_handler(rememberLack);

/** Keeps files from getting the number of a closed standard stream: printed text would
 * go into the file. Writing to the stream still fails. */
void
occupyStandardStreams()
{
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream)
    if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF)
      ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY); // takes it
}
} // namespace

std::string
wordsOfCurrent()
try {
  throw;
} catch (const std::bad_alloc& e) {
  return wordsOf(e);
} catch (const std::length_error& e) { // a container above its max_size()
  return std::string("not enough memory: the request exceeds every limit (") +
         e.what() + ")";
} catch (const std::filesystem::filesystem_error& e) {
  return wordsOf(e);
} catch (const std::system_error& e) {
  if (e.code() == std::errc::resource_unavailable_try_again)
    return "no more threads, or no memory for a thread";
  return e.what();
} catch (const std::exception& e) {
  return *e.what() ? e.what() : typeid(e).name();
} catch (...) {
  const std::type_info* const type = abi::__cxa_current_exception_type();
  return std::string("an exception of an unknown kind was thrown: ") +
         (type ? type->name() : "no C++ exception");
}

int
runMain(const std::string& name,
        int argc,
        char** argv,
        const std::function<int(const std::vector<std::string>&)>& body)
try {
  occupyStandardStreams();
  makeLocaleValid();
  std::signal(SIGPIPE, SIG_IGN); // `... | head` must not leave half a run
  std::signal(SIGXFSZ, SIG_IGN); // a file above the size limit gives an error message
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  const std::string steps = argc > 1 ? "" : firstSteps(name);
  if (!steps.empty()) {
    std::cerr << steps;
    return kUsage;
  }
  const int code = body(std::vector<std::string>(argv + 1, argv + argc));
  if (code == kDone || code == kDoubtful)
    flushOutput();
  return code;
} catch (const UsageError& e) {
  return report(name, e.what(), kUsage);
} catch (boost::program_options::error& e) {
  return report(name, wordsOf(e), kUsage);
} catch (...) {
  return report(name, wordsOfCurrent(), kFailed);
}

namespace {
/** \brief Calls check and turns its BadArgument into a UsageError that names the option
 * of the library's field. */
void
checkRenamed(const std::function<void()>& check,
             const std::function<std::string(const std::string&)>& optionOf)
try {
  check();
} catch (const BadArgument& e) {
  const std::string message = e.what();
  // "field = value, but ..."; the value may be long: a regular expression would recurse
  // once per character.
  const std::size_t end = message.find(" = ");
  const std::string field = message.substr(0, end);
  if (end == std::string::npos || field.empty() ||
      field.find_first_not_of("abcdefghijklmnopqrstuvwxyz_ ") != std::string::npos)
    throw UsageError(message);
  throw UsageError("--" + optionOf(field) + message.substr(end));
}
} // namespace

void
checkOptions(const std::function<void()>& check,
             const std::map<std::string, std::string>& words)
{
  checkRenamed(check, [&](const std::string& field) {
    const auto word = words.find(field);
    std::string option = word == words.end() ? field : word->second;
    std::replace(option.begin(), option.end(), '_', '-');
    return option;
  });
}

void
checkOption(const std::string& option, const std::function<void()>& check)
{
  checkRenamed(check, [&](const std::string&) { return option; });
}

namespace {
/** \return whether standard output is a pipe whose reader has closed, as `head` does */
bool
hasReaderLeft()
{
  pollfd output{STDOUT_FILENO, POLLOUT, 0};
  return ::poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}
} // namespace

void
flushOutput()
{
  if (!std::cout.rdbuf()) // a helper process prints no errors
    return;
  errno = 0;
  std::cout.flush();
  const bool arrived = std::fflush(stdout) == 0;
  const std::string reason = errno ? std::string(": ") + std::strerror(errno) : "";
  if ((!arrived || std::ferror(stdout) || !std::cout) && !hasReaderLeft())
    throw IoFailed("cannot write to the standard output" + reason);
}

} // namespace pcl6d::app
