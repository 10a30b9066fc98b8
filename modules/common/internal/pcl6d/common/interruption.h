// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <atomic>

/** \file Stopping long work from another thread: at Ctrl-C, or when a window is closed. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief Thrown by work that was asked to stop. Not derived from std::exception: code that
 * handles errors of the work passes it on to the caller who asked for the stop.
 * \ingroup common */
struct Interrupted {};

/** \brief Stops the work of a thread when a flag is set.
 *
 * During the lifetime of the object, parallelFor() and parallelBlocks() of this thread begin no
 * step once the flag is true, and throw Interrupted; so do loops inside their steps, in every
 * thread. The work stops within the time of a few steps: milliseconds for most functions of the
 * suite. Objects in the middle of a change are left as after any other exception.
 * \code
 * std::atomic<bool> stop{false}; // set by another thread
 * const pcl6d::StopScope scope(stop);
 * try {
 *   pcl6d::estimateNormals(points, tree);
 * } catch (const pcl6d::Interrupted&) {
 * }
 * \endcode
 * \ingroup common */
class StopScope {
public:
  /** \param[in] flag must outlive the object. Replaces the flag of a scope around this one. */
  explicit StopScope(const std::atomic<bool>& flag);
  ~StopScope();
  StopScope(const StopScope&) = delete;
  StopScope&
  operator=(const StopScope&) = delete;

private:
  const std::atomic<bool>* outer_;
};

/** \brief For long loops of a single thread. \throws Interrupted the flag of the StopScope of this
 * thread is true */
void
throwIfStopped();

} // namespace pcl6d
