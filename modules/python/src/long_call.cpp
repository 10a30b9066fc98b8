// SPDX-License-Identifier: BSD-3-Clause
#include "long_call.h"

#include <pcl6d/common/error.h>

#include <chrono>
#include <condition_variable>
#include <exception>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <vector>

namespace pcl6d::python {

namespace {
constexpr std::chrono::milliseconds kLook{50};       ///< between looks for signals
constexpr std::chrono::milliseconds kPatience{1000}; ///< for stopped work

/** State of a call, shared by the caller and the thread. */
struct Call {
  CallWatch watch;
  std::function<void(CallWatch&)> work;
  Stopping stopping = Stopping::kAmidWork;
  std::mutex mutex;
  std::condition_variable ended;
  bool is_over = false;
  std::exception_ptr error;

  void
  run()
  {
    try {
      std::optional<StopScope> scope;
      if (stopping == Stopping::kAmidWork)
        scope.emplace(watch.flag());
      work(watch);
    } catch (...) {
      error = std::current_exception();
    }
    work = nullptr; // frees the captured data
    const std::lock_guard<std::mutex> lock(mutex);
    is_over = true;
    ended.notify_all();
  }

  /** \return whether the work ended within a time; without Python's lock */
  bool
  waitFor(std::chrono::milliseconds time)
  {
    const py::gil_scoped_release release;
    std::unique_lock<std::mutex> lock(mutex);
    return ended.wait_for(lock, time, [this] { return is_over; });
  }
};

/** Threads abandoned by their callers. A child process does not inherit the threads of the
 * parent. */
struct Background {
  pid_t process = getpid();
  std::vector<std::thread> threads;
};

Background&
background()
{
  static auto* const threads = new Background; // outlives all threads
  return *threads;
}

void
keep(std::thread thread)
{
  Background& kept = background();
  if (kept.process != getpid()) {
    new (&kept)
        Background; // handles of a parent's threads cannot be joined, nor destroyed
    kept.process = getpid();
  }
  kept.threads.push_back(std::move(thread));
}

/** \throws error_already_set a signal handler or the callback raised an exception */
void
serve(const py::object& progress, CallWatch& watch)
{
  for (const Progress& report : watch.takeReports())
    if (!progress.is_none())
      progress(report.stage, report.done, report.total);
  if (PyErr_CheckSignals() != 0)
    throw py::error_already_set();
}
} // namespace

void
CallWatch::report(const Progress& progress)
{
  if (stopped_)
    throw Interrupted();
  tell(progress);
}

void
CallWatch::tell(const Progress& progress)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!reports_.empty() && reports_.back().stage == progress.stage)
    reports_.back() = progress;
  else
    reports_.push_back(progress);
}

ProgressCallback
CallWatch::callback()
{
  return [this](const Progress& progress) { report(progress); };
}

std::deque<Progress>
CallWatch::takeReports()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(reports_, {});
}

void
runLong(const py::object& progress,
        std::function<void(CallWatch&)> work,
        Stopping stopping)
{
  if (!progress.is_none() && !PyCallable_Check(progress.ptr()))
    throw BadArgument(
        "progress is not callable, but must be a function of stage, done and "
        "total, or None");
  const auto call = std::make_shared<Call>();
  call->work = std::move(work);
  call->stopping = stopping;
  std::thread thread;
  try {
    thread = std::thread([call] { call->run(); });
  } catch (const std::system_error&) {
    throw ComputeFailed(
        "the system has no thread left for the call: end other work first");
  }
  try {
    while (!call->waitFor(kLook))
      serve(progress, call->watch);
    serve(progress, call->watch);
  } catch (...) {
    call->watch.stop();
    if (call->waitFor(kPatience))
      thread.join();
    else
      keep(std::move(thread));
    throw;
  }
  thread.join();
  if (call->error)
    std::rethrow_exception(call->error);
}

void
waitForStopped()
{
  Background& kept = background();
  if (kept.process != getpid())
    return;
  std::vector<std::thread> threads;
  threads.swap(kept.threads);
  const py::gil_scoped_release release;
  for (auto& thread : threads)
    thread.join();
}

} // namespace pcl6d::python
