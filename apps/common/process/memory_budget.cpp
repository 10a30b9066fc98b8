// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/listed_options.h"
#include "common/process/memory_budget.h"
#include "common/process/scratch_arena.h"

#include <pcl6d/common/error.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <limits>
#include <malloc.h>
#include <new>
#include <system_error>
#include <thread>
#include <unistd.h>

namespace pcl6d::app {

namespace {
constexpr std::size_t kMega = std::size_t{1} << 20;

/** Smaller blocks stay on the heap: rounding up to pages would waste more memory than
 * moving saves. */
constexpr std::size_t kLargeBlock = 2 << 10;

/** Share of the budget above which pages are released. The rest covers allocations
 * until the next check of the watch thread. */
constexpr double kFull = 0.75;
/** Share of the budget: while the heap is above it, new large blocks go to the file. */
constexpr double kHeap = 0.4;

/** [bytes/s] Upper bound of the growth of the process, about the speed of clearing pages. */
constexpr double kFastest = 4e9;
constexpr double kLongestPause = 0.1, kShortestPause = 0.001; // [s]

constexpr std::chrono::milliseconds kTrimPause(500);

/** [bytes] a point of the scan at work, counted twice (as read, and gated), its rays,
 * its tree. */
constexpr std::size_t kBytesPerPoint = 4;
/** [bytes] of the program without any scan. */
constexpr std::size_t kProgram = 160 * kMega;

/** State read by operator new; never destroyed, as memory is freed until the very end. */
ScratchArena* arena = nullptr;
std::size_t budget = 0;
std::size_t most_heap = std::numeric_limits<std::size_t>::max(); ///< [bytes]
bool is_strict = false; ///< the user gave the budget: no room in the file is an error
/** [bytes] heap at the last check, and large blocks taken since */
std::atomic<std::size_t> heap{0};

/** \brief Resident memory of the process. */
struct Residence {
  std::size_t all = 0;  ///< [bytes]
  std::size_t heap = 0; ///< [bytes] resident outside files
};

Residence
residence(int statm)
{
  char text[128] = {};
  if (::pread(statm, text, sizeof text - 1, 0) <= 0)
    return {};
  unsigned long size = 0, resident = 0, shared = 0;
  if (std::sscanf(text, "%lu %lu %lu", &size, &resident, &shared) != 3)
    return {};
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  return {resident * page, (resident - std::min(resident, shared)) * page};
}

/** Looks the more often the less is left. */
void
watch()
{
  const int statm = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (statm < 0)
    return;
  const auto full = static_cast<std::size_t>(kFull * static_cast<double>(budget));
  while (true) {
    const Residence now = residence(statm);
    heap = now.heap;
    if (now.all > full)
      arena->letGo();
    const double left =
        std::max(0.0, static_cast<double>(most_heap) - static_cast<double>(now.all));
    std::this_thread::sleep_for(std::chrono::duration<double>(
        std::clamp(left / kFastest, kShortestPause, kLongestPause)));
  }
}

/** Returns freed memory of the heap to the system, in a thread of its own: trimming
 * takes too long for the watch thread. */
void
trim()
{
  while (true) {
    std::this_thread::sleep_for(kTrimPause);
    if (heap > most_heap)
      ::malloc_trim(0);
  }
}
} // namespace

void
MemoryOption::describe(OptionList& list)
{
  list.addWord("memory SIZE",
               bytes,
               [this](const std::string& word) { bytes = memorySize(word); })
      .as(OptionRole::kSession)
      .withDefault("half of the machine's")
      .withHelp(
          "most memory to use at a time, for example 500M or 1.5G; the rest is kept in "
          "a file in the output folder during the run. Never changes the result");
}

void
MemoryOption::addTo(OptionTable& table)
{
  OptionList list;
  describe(list);
  addOption(table, list.rows().front());
}

std::size_t
memorySize(const std::string& text)
{
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  std::string unit(end);
  unit.erase(std::remove(unit.begin(), unit.end(), ' '), unit.end());
  std::transform(unit.begin(), unit.end(), unit.begin(), ::toupper);
  if (unit.size() > 1 && unit.back() == 'B')
    unit.pop_back();
  if (unit.size() > 1 && unit.back() == 'I')
    unit.pop_back();
  static const std::string kUnits = "BKMGT";
  const std::size_t power = unit.empty() ? 0 : kUnits.find(unit);
  if (end == text.c_str() || unit.size() > 1 || power == std::string::npos ||
      !std::isfinite(number))
    throw UsageError("--memory = " + text + ", but expected a size like 500M or 1.5G");
  const double bytes = std::ldexp(number, 10 * static_cast<int>(power));
  if (!(bytes >= 1))
    throw UsageError("--memory = " + text + ", but must be > 0");
  if (bytes > static_cast<double>(machineMemory()))
    throw UsageError("--memory = " + text + ", but the machine has " +
                     std::to_string(machineMemory() / kMega) + "M");
  return static_cast<std::size_t>(bytes);
}

std::size_t
machineMemory()
{
  const long pages = ::sysconf(_SC_PHYS_PAGES), page = ::sysconf(_SC_PAGESIZE);
  std::size_t bytes = pages > 0 && page > 0 ? static_cast<std::size_t>(pages) *
                                                  static_cast<std::size_t>(page)
                                            : 1024 * kMega;
  for (const char* file :
       {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    std::size_t limit = 0;
    if (std::ifstream(file) >> limit && limit > 0) // "max" is no number
      bytes = std::min(bytes, limit);
  }
  return bytes;
}

namespace {
std::filesystem::path
nearestFolder(const std::filesystem::path& path)
{
  std::filesystem::path folder = std::filesystem::absolute(path);
  std::error_code ignored;
  while (!std::filesystem::is_directory(folder, ignored) && folder.has_relative_path())
    folder = folder.parent_path();
  return folder;
}
} // namespace

MemoryBudget::MemoryBudget(const MemoryOption& option,
                           const std::filesystem::path& folder)
{
  if (arena)
    return;
  budget = option.bytes > 0 ? option.bytes : machineMemory() / 2;
  most_heap = static_cast<std::size_t>(kHeap * static_cast<double>(budget));
  is_strict = option.bytes > 0;
  if (is_strict) // large blocks of the heap go back to the system at once
    ::mallopt(M_MMAP_THRESHOLD, 256 << 10);
  arena = new ScratchArena(nearestFolder(folder));
  // without the threads, freed large blocks still count: more data goes to the file
  try {
    std::thread(watch).detach();
    std::thread(trim).detach();
  } catch (const std::system_error&) {}
}

std::size_t
MemoryBudget::bytes() const
{
  return budget;
}

void
MemoryBudget::require(std::size_t points, const std::string& scan) const
{
  const std::size_t needed = kProgram + 2 * points * kBytesPerPoint;
  if (needed > bytes())
    throw IoFailed(scan + ": " + std::to_string(points) +
                   " points; two scans of this size need --memory " +
                   std::to_string(needed / kMega + 1) + "M");
}

std::size_t
MemoryBudget::scratch() const
{
  return arena->size();
}

namespace {
/** \brief The disk is full. */
class NoScratch : public std::bad_alloc {
public:
  const char*
  what() const noexcept override
  {
    return "neither memory within --memory nor room in the output folder is left";
  }
};

/** \param[in] alignment a power of two up to the page size; 0: the default
 * \throws std::bad_alloc out of memory */
void*
takeBlock(std::size_t bytes, std::size_t alignment = 0)
{
  if (bytes >= kLargeBlock && arena) {
    if (heap.load(std::memory_order_relaxed) + bytes > most_heap) {
      if (void* const block = arena->allocate(bytes))
        return block;
      if (is_strict)
        throw NoScratch();
    }
    heap.fetch_add(bytes, std::memory_order_relaxed);
  }
  bytes = std::max<std::size_t>(bytes, 1);
  void* block = nullptr;
  if (alignment == 0)
    block = std::malloc(bytes);
  else if (::posix_memalign(&block, alignment, bytes) != 0)
    block = nullptr;
  if (block)
    return block;
  if (const std::new_handler tell = std::get_new_handler())
    tell(); // throws if memory is still lacking
  throw std::bad_alloc();
}

/// Like takeBlock(), but returns a null pointer when out of memory.
void*
takeBlockOrNull(std::size_t bytes, std::size_t alignment = 0) noexcept
{
  try {
    return takeBlock(bytes, alignment);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

void
giveBlock(void* block) noexcept
{
  if (arena && arena->owns(block))
    arena->free(block);
  else
    std::free(block);
}
} // namespace

} // namespace pcl6d::app

// Replacements of the global operators; the array forms call these functions. The
// nothrow forms are replaced too: a sanitizer's own would allocate memory that these
// deletes hand to malloc's free().
void*
operator new(std::size_t bytes)
{
  return pcl6d::app::takeBlock(bytes);
}

void*
operator new(std::size_t bytes, std::align_val_t alignment)
{
  return pcl6d::app::takeBlock(bytes, static_cast<std::size_t>(alignment));
}

void*
operator new(std::size_t bytes, const std::nothrow_t&) noexcept
{
  return pcl6d::app::takeBlockOrNull(bytes);
}

void*
operator new(std::size_t bytes,
             std::align_val_t alignment,
             const std::nothrow_t&) noexcept
{
  return pcl6d::app::takeBlockOrNull(bytes, static_cast<std::size_t>(alignment));
}

void
operator delete(void* block) noexcept
{
  pcl6d::app::giveBlock(block);
}

void
operator delete(void* block, std::size_t) noexcept
{
  pcl6d::app::giveBlock(block);
}

void
operator delete(void* block, std::align_val_t) noexcept
{
  pcl6d::app::giveBlock(block);
}

void
operator delete(void* block, std::size_t, std::align_val_t) noexcept
{
  pcl6d::app::giveBlock(block);
}
