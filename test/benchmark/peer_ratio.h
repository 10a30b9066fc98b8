// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace pcl6d::benchmarks {

/** \brief One piece of work, done by us and by a peer. */
struct PeerJob {
  std::function<void()> ours;   ///< timed
  std::function<void()> theirs; ///< timed
  /** Called once, after an untimed call of both: calls SkipWithError() unless the
   * results are equally good, and may add counters to the table. */
  std::function<void(benchmark::State&)> check;
};

/** \brief A job with its name in the table and in the ratio line. */
struct PeerCase {
  std::string name;              ///< such as "nearest/30000"; no blanks
  std::string peer;              ///< such as "pcl::search::KdTree"; no blanks
  unsigned int threads = 1;      ///< that ours may use
  int repetitions = 21;          ///< timed calls of each; odd, for the median
  std::function<PeerJob()> make; ///< prepares data; not timed
};

/** \return how many repetitions make a good median in a fair time. \param[in] count of
 * points */
inline int
repetitionsFor(std::size_t count)
{
  return count < 500000 ? 21 : 7;
}

/** \brief Puts a case on the list of runPeerCases(). */
void
addPeerCase(const PeerCase& peer_case);

/** \brief Takes our own option `--threads=N` or `--threads=N,M` from the command line,
 * before Google Benchmark sees it; exits with 2 if it is malformed.
 * \return the counts of threads that the cases shall run ours with; 1, 2 if not given */
std::vector<unsigned int>
takeThreadCounts(int& argc, char** argv);

/** \brief Runs the cases that the command line of Google Benchmark chooses. The
 * repetitions take turns, ours, peer, ours, peer, so that a busy machine slows down
 * both. The last lines of the output are, with medians of wall time,
 * `ratio <case> <peer> threads=<n> <peer time / our time>`.
 * \return exit code: 0 done, 1 a check failed, 2 command line wrong or no case */
int
runPeerCases(int argc, char** argv);

} // namespace pcl6d::benchmarks
