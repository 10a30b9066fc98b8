// SPDX-License-Identifier: BSD-3-Clause
#include "stop_flag.h"

#include <pcl6d/common/interruption.h>
#include <pcl6d/common/parallel.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <limits>
#include <memory>
#include <mutex>
#include <new>
#include <pthread.h>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace pcl6d {

namespace {
/** \brief Worker threads that help with loops.
 *
 * The thread that calls run() works too, and finally waits only for steps that a helper has
 * begun, never for a helper still asleep: on a busy machine a loop of short blocks takes no
 * longer than on one thread. Calls may nest and come from any thread. */
class ThreadPool {
public:
  /** \return the pool of the process; threads are started on first use */
  static ThreadPool&
  instance();
  ~ThreadPool();

  /** \brief Calls body(0) .. body(count - 1) from at most num_threads threads, including the
   * caller; from fewer, if the system has no threads left. An exception of the body is
   * rethrown; the exception of the lowest index wins */
  void
  run(std::size_t count,
      std::size_t num_threads,
      const std::function<void(std::size_t)>& body);

private:
  struct Loop;

  /** A forked process inherits the pool without threads, and starts new threads. */
  ThreadPool();
  void
  forgetThreads();
  void
  offer(const std::shared_ptr<Loop>& loop, std::size_t helpers);
  void
  work();

  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::shared_ptr<Loop>> offers_; ///< each loop once per helper it can use
  std::vector<std::thread> threads_;
  bool stop_ = false;
};

/** One parallel loop. Lives until the last helper releases the loop. */
struct ThreadPool::Loop {
  Loop(std::size_t count_, const std::function<void(std::size_t)>& body_)
  : count(count_), body(body_)
  {}

  /** Takes steps until the loop is exhausted. Steps after a stop are empty. */
  void
  takeSteps()
  {
    const std::atomic<bool>* const outer = std::exchange(common::stopFlag(), stop);
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        if (stop != nullptr && *stop)
          is_stopped = true;
        else
          body(i);
      } catch (...) {
        keepError(i);
      }
      if (++finished == count) {
        const std::lock_guard<std::mutex> lock(mutex);
        all_finished.notify_all();
      }
    }
    common::stopFlag() = outer;
  }

  void
  waitForHelpers()
  {
    for (int i = 0; i < 1000 && finished < count; ++i)
      std::this_thread::yield(); // most steps are short
    std::unique_lock<std::mutex> lock(mutex);
    all_finished.wait(lock, [this] { return finished == count; });
  }

  void
  keepError(std::size_t index)
  {
    const std::lock_guard<std::mutex> lock(mutex);
    if (index >= error_index)
      return;
    error_index = index;
    error = std::current_exception();
  }

  const std::size_t count;
  /** The caller's; called only for steps, which end before the caller's run(). */
  const std::function<void(std::size_t)>& body;
  /** Of the StopScope of the caller, or null; read only for steps. */
  const std::atomic<bool>* const stop = common::stopFlag();
  std::atomic<bool> is_stopped{false};
  std::atomic<std::size_t> next{0};
  std::atomic<std::size_t> finished{0};
  std::mutex mutex;
  std::condition_variable all_finished;
  std::exception_ptr error;
  std::size_t error_index = std::numeric_limits<std::size_t>::max();
};

ThreadPool&
ThreadPool::instance()
{
  static ThreadPool pool;
  return pool;
}

ThreadPool::ThreadPool()
{
  // The lock is held across the fork, so the child never sees a half-queued loop.
  pthread_atfork([] { instance().mutex_.lock(); },
                 [] { instance().mutex_.unlock(); },
                 [] { instance().forgetThreads(); });
}

/** Handles of threads of another process can be neither joined nor destroyed: they are kept. */
void
ThreadPool::forgetThreads()
{
  new (&mutex_) std::mutex;
  new (&wake_) std::condition_variable;
  // Not destroyed at the end, and in reach of a search for leaks.
  static auto& of_parents = *new std::vector<std::vector<std::thread>>;
  of_parents.push_back(std::move(threads_));
  threads_.clear();
  offers_.clear();
}

ThreadPool::~ThreadPool()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  for (auto& thread : threads_)
    thread.join();
}

void
ThreadPool::run(std::size_t count,
                std::size_t num_threads,
                const std::function<void(std::size_t)>& body)
{
  const auto loop = std::make_shared<Loop>(count, body);
  offer(loop, num_threads - 1);
  loop->takeSteps();
  loop->waitForHelpers();
  if (loop->is_stopped)
    throw Interrupted();
  if (loop->error)
    std::rethrow_exception(loop->error);
}

void
ThreadPool::offer(const std::shared_ptr<Loop>& loop, std::size_t helpers)
{
  // Helpers are optional: if the system lacks threads or memory, the existing threads do the
  // work, in the extreme case the caller alone.
  try {
    const std::lock_guard<std::mutex> lock(mutex_);
    try {
      while (threads_.size() < helpers)
        threads_.emplace_back([this] { work(); });
    } catch (const std::system_error&) {}
    helpers = std::min(helpers, threads_.size());
    offers_.insert(offers_.end(), helpers, loop);
  } catch (const std::bad_alloc&) {}
  if (helpers == 1)
    wake_.notify_one();
  else
    wake_.notify_all();
}

void
ThreadPool::work()
{
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return stop_ || !offers_.empty(); });
    if (stop_)
      return;
    const std::shared_ptr<Loop> loop = std::move(offers_.front());
    offers_.pop_front();
    lock.unlock();
    loop->takeSteps(); // returns at once if the caller has finished meanwhile
    lock.lock();
  }
}
} // namespace

unsigned int
threadCount(unsigned int wanted)
{
  return wanted > 0 ? wanted : std::max(1u, std::thread::hardware_concurrency());
}

void
parallelFor(std::size_t count,
            unsigned int num_threads,
            const std::function<void(std::size_t)>& body)
{
  const std::size_t threads = std::min<std::size_t>(threadCount(num_threads), count);
  if (threads > 1)
    return ThreadPool::instance().run(count, threads, body);
  const std::atomic<bool>* const stop = common::stopFlag();
  for (std::size_t i = 0; i < count; ++i) {
    if (stop != nullptr && *stop)
      throw Interrupted();
    body(i);
  }
}

std::size_t
parallelBlocks(std::size_t size,
               std::size_t block_size,
               unsigned int num_threads,
               const std::function<void(const Block&)>& body)
{
  const std::size_t num_blocks = (size + block_size - 1) / block_size;
  parallelFor(num_blocks, num_threads, [&](std::size_t i) {
    body({i, i * block_size, std::min(size, (i + 1) * block_size)});
  });
  return num_blocks;
}

} // namespace pcl6d
