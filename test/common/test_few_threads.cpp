// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/parallel.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cerrno>
#include <dlfcn.h>
#include <pthread.h>
#include <set>
#include <stdexcept>
#include <thread>

/** \file Loops where the system has few threads to give: this program's pthread_create()
 * stands in for the system's, also for the libraries. */
namespace {
int threads_left = 0; ///< that can still be made
int threads_refused = 0;
} // namespace

extern "C" int
pthread_create(pthread_t* thread,
               const pthread_attr_t* attributes,
               void* (*body)(void*),
               void* argument) noexcept
{
  if (threads_left-- <= 0) {
    ++threads_refused;
    return EAGAIN; // as under a limit of processes
  }
  static const auto real =
      reinterpret_cast<decltype(&pthread_create)>(::dlsym(RTLD_NEXT, "pthread_create"));
  return real(thread, attributes, body, argument);
}

namespace {
/** \return how many steps of a loop were taken, and by which threads */
std::pair<int, std::set<std::thread::id>>
takeSteps(unsigned int num_threads)
{
  std::atomic<int> steps{0};
  std::mutex mutex;
  std::set<std::thread::id> by;
  pcl6d::parallelFor(1000, num_threads, [&](std::size_t) {
    ++steps;
    const std::lock_guard<std::mutex> lock(mutex);
    by.insert(std::this_thread::get_id());
  });
  return {steps, by};
}
} // namespace

// One test, as the threads of the pool stay: none, then one, then no more.
TEST(FewThreads, DoAllOfTheWork)
{
  for (const int allowed : {0, 1, 0}) {
    threads_left = allowed;
    threads_refused = 0;
    for (int loop = 0; loop < 20; ++loop) {
      const auto [steps, by] = takeSteps(8);
      EXPECT_EQ(steps, 1000);
      EXPECT_LE(by.size(), 2u);
    }
    EXPECT_GT(threads_refused, 0) << "the test refuses nothing";
  }
  threads_left = 0;
  EXPECT_THROW(pcl6d::parallelFor(10,
                                  8,
                                  [](std::size_t i) {
                                    i == 3 ? throw std::runtime_error("3") : void();
                                  }),
               std::runtime_error);
}
