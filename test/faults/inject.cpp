// SPDX-License-Identifier: BSD-3-Clause
#include "inject.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <execinfo.h>
#include <fcntl.h>
#include <initializer_list>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace pcl6d::inject {

namespace {
enum class Mode { kFail, kFrom, kShort, kKill };

pid_t armed_process = 0; ///< 0: not yet in main()
const char* kinds = "";
std::uint64_t failing_call = 0;
Mode mode = Mode::kFail;
std::atomic<std::uint64_t> own_counter{0};
std::atomic<std::uint64_t>* counter = &own_counter;
bool shows_trace = false;
thread_local int uncounted = 0; ///< > 0: calls do not count

bool
isChosen(const char* kind)
{
  const std::size_t size = std::strlen(kind);
  for (const char* at = std::strstr(kinds, kind); at; at = std::strstr(at + 1, kind))
    if ((at == kinds || at[-1] == ',') && (at[size] == '\0' || at[size] == ','))
      return true;
  return false;
}

void
showTrace(const char* kind)
{
  const Uncounted uncounted_calls;
  void* frames[40];
  const int count = ::backtrace(frames, 40);
  ::dprintf(2, "[inject: %s]\n", kind);
  ::backtrace_symbols_fd(frames, count, 2);
}

/** Shows where a program ends, or was when it was asked for that, as what it hangs in. */
void
showEnd(int signal)
{
  showTrace("end");
  ::signal(signal, SIG_DFL);
  ::raise(signal);
}

/** Counts a call. \return whether it is to fail */
bool
isHit(const char* kind)
{
  if (armed_process == 0 || uncounted > 0 || !isChosen(kind) ||
      ::getpid() != armed_process)
    return false;
  const std::uint64_t number = counter->fetch_add(1) + 1;
  const bool hit = failing_call > 0 && (number == failing_call ||
                                        (mode == Mode::kFrom && number > failing_call));
  if (hit && shows_trace)
    showTrace(kind);
  if (hit && mode == Mode::kKill)
    ::kill(armed_process, SIGKILL);
  return hit;
}

void
openCounter(const char* path)
{
  const int file = ::open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file < 0 || ::ftruncate(file, sizeof(std::uint64_t)) != 0)
    return;
  void* const memory = ::mmap(
      nullptr, sizeof(std::uint64_t), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (memory != MAP_FAILED)
    counter = static_cast<std::atomic<std::uint64_t>*>(memory);
  ::close(file);
}

Mode
modeOf(const char* word)
{
  const auto is = [&](const char* other) {
    return word && std::strcmp(word, other) == 0;
  };
  return is("from")    ? Mode::kFrom
         : is("short") ? Mode::kShort
         : is("kill")  ? Mode::kKill
                       : Mode::kFail;
}

/** Reads the environment; a process that this one starts has it, too, but stays as it is. */
void
arm()
{
  const char* const word = std::getenv("PCL6D_INJECT_KIND");
  if (!word || std::getenv("PCL6D_INJECT_ARMED"))
    return;
  ::setenv("PCL6D_INJECT_ARMED", "1", 1);
  kinds = word;
  if (const char* const number = std::getenv("PCL6D_INJECT_AT"))
    failing_call = std::strtoull(number, nullptr, 10);
  mode = modeOf(std::getenv("PCL6D_INJECT_MODE"));
  shows_trace = std::getenv("PCL6D_INJECT_TRACE") != nullptr;
  if (shows_trace)
    for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGALRM})
      ::signal(signal, showEnd);
  if (const char* const file = std::getenv("PCL6D_INJECT_COUNT"))
    openCounter(file);
  armed_process = ::getpid();
}

using Main = int (*)(int, char**, char**);
Main program = nullptr;

int
armedMain(int argc, char** argv, char** environment)
{
  arm();
  return program(argc, argv, environment);
}
} // namespace

bool
fails(const char* kind, int error)
{
  if (!isHit(kind))
    return false;
  errno = error;
  return true;
}

bool
shortens()
{
  return mode == Mode::kShort;
}

std::size_t
taken(std::size_t size, bool hit)
{
  return hit ? (size + 1) / 2 : size;
}

bool
isOnDisk(int file)
{
  struct stat status {};
  const int error = errno;
  const bool regular =
      file > STDERR_FILENO && ::fstat(file, &status) == 0 && S_ISREG(status.st_mode);
  errno = error;
  return regular;
}

Uncounted::Uncounted()
{
  ++uncounted;
}

Uncounted::~Uncounted()
{
  --uncounted;
}

} // namespace pcl6d::inject

#pragma GCC visibility push(default)
extern "C" {

int
__libc_start_main(pcl6d::inject::Main main,
                  int argc,
                  char** argv,
                  pcl6d::inject::Main init,
                  void (*fini)(),
                  void (*rtld_fini)(),
                  void* stack)
{
  using namespace pcl6d::inject;
  using Start = int(Main, int, char**, Main, void (*)(), void (*)(), void*);
  program = main;
  auto* const start = reinterpret_cast<Start*>(::dlsym(RTLD_NEXT, "__libc_start_main"));
  return start(armedMain, argc, argv, init, fini, rtld_fini, stack);
}

void*
dlopen(const char* file, int flags)
{
  PCL6D_NEXT(dlopen);
  const pcl6d::inject::Uncounted uncounted;
  return real(file, flags);
}

} // extern "C"
#pragma GCC visibility pop
