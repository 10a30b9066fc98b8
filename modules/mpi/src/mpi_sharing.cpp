// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/mpi/mpi_sharing.h>

// The deprecated C++ bindings of MPI would need an extra library.
#define OMPI_SKIP_MPICXX
#define MPICH_SKIP_MPICXX
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <mpi.h>
#include <thread>

namespace pcl6d {

namespace {
/** MPI counts in int: longer messages go in parts. */
constexpr std::size_t kLargestPart = std::size_t{1} << 30; // [bytes]

/** Fields of a header: size of the message, failure flag, failed item. */
using Header = std::array<std::uint64_t, 3>;

void
require(int code, const char* what)
{
  if (code != MPI_SUCCESS)
    throw IoFailed(std::string("MPI: ") + what + " failed");
}

/** MPI's own waiting takes a whole core. */
void
wait(MPI_Request& request)
{
  constexpr int kEager = 200; // polls before sleeping
  constexpr std::chrono::microseconds kLongest(1000);
  std::chrono::microseconds pause(20);
  for (int tries = 0;; ++tries) {
    int done = 0;
    require(MPI_Test(&request, &done, MPI_STATUS_IGNORE), "waiting");
    if (done != 0)
      return;
    if (tries < kEager) {
      std::this_thread::yield();
      continue;
    }
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, kLongest);
  }
}

/** Sends the bytes of a rank to every rank. */
void
broadcast(std::string& bytes, int from)
{
  for (std::size_t done = 0; done < bytes.size(); done += kLargestPart) {
    const std::size_t part = std::min(kLargestPart, bytes.size() - done);
    MPI_Request request = MPI_REQUEST_NULL;
    require(MPI_Ibcast(bytes.data() + done,
                       static_cast<int>(part),
                       MPI_BYTE,
                       from,
                       MPI_COMM_WORLD,
                       &request),
            "sending to all");
    wait(request);
  }
}

/** Sends the bytes of a rank to the first rank. */
void
send(std::string& bytes, int from, int rank)
{
  for (std::size_t done = 0; done < bytes.size(); done += kLargestPart) {
    const int part = static_cast<int>(std::min(kLargestPart, bytes.size() - done));
    MPI_Request request = MPI_REQUEST_NULL;
    char* data = bytes.data() + done;
    require(rank == 0
                ? MPI_Irecv(data, part, MPI_BYTE, from, 0, MPI_COMM_WORLD, &request)
                : MPI_Isend(data, part, MPI_BYTE, 0, 0, MPI_COMM_WORLD, &request),
            "sending to the first process");
    wait(request);
  }
}
} // namespace

MpiSharing::MpiSharing()
{
  int started = 0, level = 0, rank = 0, size = 1;
  require(MPI_Initialized(&started), "starting");
  if (started != 0)
    throw IoFailed("MPI was already started in the process");
  require(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level), "starting");
  require(MPI_Comm_rank(MPI_COMM_WORLD, &rank), "starting");
  require(MPI_Comm_size(MPI_COMM_WORLD, &size), "starting");
  rank_ = static_cast<std::size_t>(rank);
  num_ranks_ = static_cast<std::size_t>(size);
}

MpiSharing::~MpiSharing()
{
  MPI_Request request = MPI_REQUEST_NULL;
  try {
    if (MPI_Ibarrier(MPI_COMM_WORLD, &request) == MPI_SUCCESS)
      wait(request);
  } catch (const IoFailed&) { // it ends anyway
  }
  MPI_Finalize();
}

std::vector<WorkSharing::Message>
MpiSharing::exchange(Message mine, Receivers receivers)
{
  const Header own = {mine.bytes.size(), mine.failed ? 1U : 0U, mine.item};
  std::vector<Header> headers(num_ranks_);
  MPI_Request request = MPI_REQUEST_NULL;
  require(MPI_Iallgather(own.data(),
                         static_cast<int>(own.size()),
                         MPI_UINT64_T,
                         headers.data(),
                         static_cast<int>(own.size()),
                         MPI_UINT64_T,
                         MPI_COMM_WORLD,
                         &request),
          "gathering");
  wait(request);
  const bool to_all = receivers == Receivers::kAll ||
                      std::any_of(headers.begin(),
                                  headers.end(),
                                  [](const Header& one) { return one[1] != 0; });
  std::vector<Message> all(num_ranks_);
  for (std::size_t r = 0; r < num_ranks_; ++r) {
    all[r].failed = headers[r][1] != 0;
    all[r].item = headers[r][2];
    if (r == rank_)
      all[r].bytes = std::move(mine.bytes);
    else if (to_all || rank_ == 0)
      all[r].bytes.resize(headers[r][0]);
    if (to_all)
      broadcast(all[r].bytes, static_cast<int>(r));
    else if (r > 0 && (rank_ == 0 || r == rank_))
      send(all[r].bytes, static_cast<int>(r), static_cast<int>(rank_));
  }
  return all;
}

} // namespace pcl6d
