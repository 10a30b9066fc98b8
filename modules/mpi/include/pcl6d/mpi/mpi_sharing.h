// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/work_sharing.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The processes that mpirun or srun has started together, as ranks that share work.
 * One at a time, for the length of main(): MPI begins and ends with it, once in a process.
 * \code
 * pcl6d::MpiSharing ranks;
 * slam.setSharing(&ranks);
 * \endcode
 * Waiting sleeps more and more, up to a millisecond, so that the cores are free for ranks that
 * compute. \ingroup mpi */
class MpiSharing : public WorkSharing {
public:
  /** \throws IoFailed MPI cannot be started, or was started before */
  MpiSharing();
  /** Waits for the other ranks to end, too. */
  ~MpiSharing() override;
  MpiSharing(const MpiSharing&) = delete;
  MpiSharing&
  operator=(const MpiSharing&) = delete;

  std::size_t
  numRanks() const override
  {
    return num_ranks_;
  }
  std::size_t
  rank() const override
  {
    return rank_;
  }

protected:
  std::vector<Message>
  exchange(Message mine, Receivers receivers) override;

private:
  std::size_t num_ranks_ = 1;
  std::size_t rank_ = 0;
};

} // namespace pcl6d
