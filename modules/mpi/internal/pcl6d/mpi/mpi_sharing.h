// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/work_sharing.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The processes started together by mpirun or srun, as ranks that share work. Create one
 * object in main(): MPI starts and ends with the object, and only once in a process.
 * \code
 * pcl6d::MpiSharing ranks;
 * slam.setSharing(&ranks);
 * \endcode
 * Waiting sleeps for increasing intervals, up to a millisecond, to leave the cores to ranks
 * that compute. \ingroup mpi */
class MpiSharing : public WorkSharing {
public:
  /** \throws IoFailed MPI cannot be started, or was started before */
  MpiSharing();
  /** Waits for all ranks to end. */
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
