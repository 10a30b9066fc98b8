// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/fuzz_target.h"

#include <pcl/console/print.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>

/** \file The entries of libFuzzer. One program serves all targets: the one that it is called
 * by, `fuzz_NAME`. */

namespace {
const pcl6d::fuzz::Target* target = nullptr;
}

extern "C" {
std::size_t
LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

int
LLVMFuzzerInitialize(int*, char*** argv)
{
  const std::string prefix = "fuzz_";
  const std::string called = std::filesystem::path((*argv)[0]).filename().string();
  if (called.rfind(prefix, 0) == 0)
    target = pcl6d::fuzz::findTarget(called.substr(prefix.size()));
  if (!target) {
    std::cerr << "call it by the name of a target:";
    for (const auto& one : pcl6d::fuzz::targets())
      std::cerr << ' ' << prefix << one.name;
    std::cerr << '\n';
    std::exit(2);
  }
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS); // as the programs do
  return 0;
}

int
LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  target->read(data, std::min(size, target->max_size));
  return 0;
}

std::size_t
LLVMFuzzerCustomMutator(std::uint8_t* data,
                        std::size_t size,
                        std::size_t max_size,
                        unsigned int seed)
{
  const std::string content(reinterpret_cast<const char*>(data), size);
  const std::string changed =
      pcl6d::fuzz::mutate(content, target->structure, max_size, seed, LLVMFuzzerMutate);
  std::copy(changed.begin(), changed.end(), data);
  return changed.size();
}
}
