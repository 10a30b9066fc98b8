// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/command_line.h"
#include "convert/verbs.h"

#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_reader.h>

namespace pcl6d::app {

int
runScans(const std::vector<std::string>& arguments)
{
  namespace po = boost::program_options;
  std::string input, output;
  CommandLine line(std::string("usage: ") + kConvert +
                   " scans IN -o OUT.pcd\nWrites a scan as PCD.\n");
  line.positional("IN", &input);
  line.group("Output").add_options()(
      "output,o", po::value(&output)->value_name("OUT")->required(), "PCD file");
  if (line.parse(arguments))
    writePcd(output, readScan(input).cloud);
  return kDone;
}

} // namespace pcl6d::app
