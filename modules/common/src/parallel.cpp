// SPDX-License-Identifier: BSD-3-Clause
#include "thread_pool.h"

#include <pcl6d/common/parallel.h>

#include <algorithm>
#include <thread>

namespace pcl6d {

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
  for (std::size_t i = 0; i < count; ++i)
    body(i);
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
