// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/fuzz_target.h"
#include "fuzz/targets.h"

#include <pcl6d/run/record_file.h>
#include <pcl6d/run/run_links_io.h>
#include <pcl6d/run/run_summary.h>

namespace pcl6d::fuzz {

int
run_summary(const std::uint8_t* data, std::size_t size)
{
  return readAsFile(".json", data, size, [](const auto& file) {
    const RunResult result = readRunSummary(file);
    expect(result.world_offset.allFinite(), "the offset is finite");
    for (const auto& scan : result.scans)
      expect(scan.T_world_scan.matrix().allFinite(), "poses are finite");
  });
}

int
run_links(const std::uint8_t* data, std::size_t size)
{
  return readAsFile(".csv", data, size, [](const auto& file) { readRunLinks(file); });
}

int
record_file(const std::uint8_t* data, std::size_t size)
{
  return readAsFile(".records", data, size, [](const auto& file) {
    std::vector<std::string> records;
    {
      RecordFile damaged(file);
      records = damaged.records();
      damaged.append("one more");
      records.emplace_back("one more");
    }
    const RecordFile mended(file);
    expect(mended.dropped() == 0, "what was damaged is gone");
    expect(mended.records() == records, "what was read is kept");
  });
}

} // namespace pcl6d::fuzz
