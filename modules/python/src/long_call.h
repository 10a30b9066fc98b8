// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/interruption.h>
#include <pcl6d/common/progress.h>

#include <atomic>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <pybind11/pybind11.h>
#include <string>
#include <utility>

/** \file Long calls: Python's threads continue meanwhile, the caller sees the progress, and
 * Ctrl-C stops the call. */
namespace pcl6d::python {

namespace py = pybind11;

/** \brief Channel between the work of a call and the caller: progress and stop request. */
class CallWatch {
public:
  /** \brief Reports progress to the caller, from any thread. */
  void
  tell(const Progress& progress);
  /** \brief tell(), with a check for a stop request. \throws Interrupted the caller has stopped
   * the call */
  void
  report(const Progress& progress);
  /** \return report() as a callback of the library; must not outlive the object */
  ProgressCallback
  callback();
  bool
  isStopped() const
  {
    return stopped_;
  }
  /** \return the flag of isStopped() */
  const std::atomic<bool>&
  flag() const
  {
    return stopped_;
  }
  void
  stop()
  {
    stopped_ = true;
  }
  /** \return the reports since the last call, the latest of each stage */
  std::deque<Progress>
  takeReports();

private:
  std::atomic<bool> stopped_{false};
  std::mutex mutex_;
  std::deque<Progress> reports_;
};

/** \brief How work ends after a stop request. */
enum class Stopping {
  kAmidWork, ///< its parallel loops and reports throw Interrupted; the work is lost
  kInSteps   ///< it looks at CallWatch::isStopped() between steps, and can be continued
};

/** \brief Runs work in a separate thread, without Python's lock, and waits for the end. Signals
 * and progress are handled in the calling thread meanwhile. After Ctrl-C, or an exception of
 * `progress`, the work is asked to stop. Work that does not stop within a second continues in the
 * background, and the result is dropped.
 * \param[in] progress None, or called with stage, done and total
 * \param[in] work must own all data used
 * \throws error_already_set Python's exception; rethrows exceptions of work */
void
runLong(const py::object& progress,
        std::function<void(CallWatch&)> work,
        Stopping stopping = Stopping::kAmidWork);

/** \return the result of work, run by runLong() */
template <typename Work>
auto
longCall(const py::object& progress, Work work, Stopping stopping = Stopping::kAmidWork)
{
  using Result = decltype(work(std::declval<CallWatch&>()));
  const auto result = std::make_shared<std::optional<Result>>();
  runLong(
      progress,
      [result, work = std::move(work)](CallWatch& watch) mutable {
        result->emplace(work(watch));
      },
      stopping);
  return std::move(**result);
}

/** \brief Waits for work left in the background: at the end of the interpreter. */
void
waitForStopped();

} // namespace pcl6d::python
