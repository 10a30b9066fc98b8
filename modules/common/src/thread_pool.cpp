// SPDX-License-Identifier: BSD-3-Clause
#include "thread_pool.h"

#include <limits>

namespace pcl6d {

/** One parallel loop. Lives until the last helper has let go of it. */
struct ThreadPool::Loop {
  Loop(std::size_t count_, const std::function<void(std::size_t)>& body_)
  : count(count_), body(body_)
  {}

  /** Takes steps until none is left. */
  void
  takeSteps()
  {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        body(i);
      } catch (...) {
        keepError(i);
      }
      if (++finished == count) {
        const std::lock_guard<std::mutex> lock(mutex);
        all_finished.notify_all();
      }
    }
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
  /** The caller's; only called for steps, which end before the caller's run(). */
  const std::function<void(std::size_t)>& body;
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
  if (loop->error)
    std::rethrow_exception(loop->error);
}

void
ThreadPool::offer(const std::shared_ptr<Loop>& loop, std::size_t helpers)
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    while (threads_.size() < helpers)
      threads_.emplace_back([this] { work(); });
    offers_.insert(offers_.end(), helpers, loop);
  }
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
    loop->takeSteps(); // at once over, if the caller has done it all meanwhile
    lock.lock();
  }
}

} // namespace pcl6d
