// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/work_sharing.h>

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace pcl6d::test {

/** \brief Where the threads of runRanks() meet. */
class RankMeeting {
public:
  explicit RankMeeting(std::size_t size) : size_(size) {}

  std::size_t
  size() const
  {
    return size_;
  }

  /** \brief Waits for all. */
  void
  meet()
  {
    std::unique_lock lock(guard_);
    const std::size_t round = round_;
    if (++here_ == size_) {
      here_ = 0;
      ++round_;
      all_here_.notify_all();
    }
    all_here_.wait(lock, [&] { return round_ != round; });
  }

private:
  std::size_t size_, here_ = 0, round_ = 0;
  std::mutex guard_;
  std::condition_variable all_here_;
};

/** \brief A thread in the place of a process. */
class ThreadRank final : public WorkSharing {
public:
  ThreadRank(std::size_t rank, RankMeeting& meeting, std::vector<ThreadRank*>& all)
  : rank_(rank), meeting_(meeting), all_(all)
  {
    all_[rank] = this;
  }

  std::size_t
  numRanks() const override
  {
    return meeting_.size();
  }
  std::size_t
  rank() const override
  {
    return rank_;
  }

protected:
  std::vector<Message>
  exchange(Message mine, Receivers receivers) override
  {
    mine_ = std::move(mine);
    meeting_.meet();
    std::vector<Message> messages;
    bool to_all = receivers == Receivers::kAll;
    for (const ThreadRank* rank : all_)
      to_all = to_all || rank->mine_.failed;
    for (const ThreadRank* rank : all_) {
      messages.push_back(rank->mine_);
      if (!to_all && rank_ != 0 && rank != this)
        messages.back().bytes.clear();
    }
    meeting_.meet();
    return messages;
  }

private:
  std::size_t rank_;
  RankMeeting& meeting_;
  std::vector<ThreadRank*>& all_;
  Message mine_;
};

/** \brief Runs a program as several ranks, each a thread. An exception of one is told to the
 * others, as main() does. \return what each threw, in words; empty: nothing */
inline std::vector<std::string>
runRanks(std::size_t size, const std::function<void(WorkSharing&)>& program)
{
  RankMeeting meeting(size);
  std::vector<ThreadRank*> all(size);
  std::vector<std::string> errors(size);
  std::vector<std::thread> threads;
  for (std::size_t r = 0; r < size; ++r)
    threads.emplace_back([&, r] {
      ThreadRank rank(r, meeting, all);
      meeting.meet();
      try {
        program(rank);
      } catch (const std::exception& e) {
        errors[r] = e.what();
        rank.fail(e.what());
      }
      meeting.meet();
    });
  for (auto& thread : threads)
    thread.join();
  return errors;
}

} // namespace pcl6d::test
