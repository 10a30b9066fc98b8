// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace pcl6d {

/** \brief Threads that wait for loops to help with.
 *
 * The thread that calls run() works too, and at the end waits only for steps that a helper
 * has begun, never for a helper that has not woken up: on a busy machine a loop of short
 * blocks then takes no longer than on one thread. Calls may nest and come from any thread. */
class ThreadPool {
public:
  /** \return the pool of the process; its threads are made when they are first needed */
  static ThreadPool&
  instance();
  ~ThreadPool();

  /** \brief Calls body(0) .. body(count - 1) from at most num_threads threads, this one
   * included. An exception of the body is thrown again; the one of the lowest index wins */
  void
  run(std::size_t count,
      std::size_t num_threads,
      const std::function<void(std::size_t)>& body);

private:
  struct Loop;

  ThreadPool() = default;
  void
  offer(const std::shared_ptr<Loop>& loop, std::size_t helpers);
  void
  work();

  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::shared_ptr<Loop>> offers_; ///< a loop once per helper that it can use
  std::vector<std::thread> threads_;
  bool stop_ = false;
};

} // namespace pcl6d
