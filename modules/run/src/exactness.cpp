// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/run/verification_io.h>

#include <cmath>
#include <iomanip>
#include <sstream>

namespace pcl6d {

namespace {
/** \return a length for people: in cm below 1 m, two digits */
std::string
lengthText(double metres)
{
  std::ostringstream digits;
  const bool is_short = metres < 1;
  const double value = is_short ? 100 * metres : metres;
  digits << std::fixed << std::setprecision(value < 10 ? 1 : 0) << value
         << (is_short ? " cm" : " m");
  return digits.str();
}

std::string
boundText(const std::vector<ScanCheck>& scans, const std::vector<std::string>& files)
{
  std::size_t worst = 0;
  for (std::size_t i = 0; i < scans.size(); ++i)
    if (scans[i].bound && *scans[i].bound > scans[worst].bound.value_or(0))
      worst = i;
  return worst == 0 ? std::string()
                    : "positions relative to the first scan are known to " +
                          lengthText(*scans[worst].bound) +
                          " or better (95 %, worst: " + files[worst] + ")";
}

std::string
noticedText(const std::vector<ScanCheck>& scans, const std::vector<std::string>& files)
{
  std::size_t worst = scans.size();
  for (std::size_t i = 0; i < scans.size(); ++i)
    if (scans[i].noticed && scans[i].tied &&
        (worst == scans.size() || scans[i].noticed->most > scans[worst].noticed->most))
      worst = i;
  if (worst == scans.size())
    return {};
  const NoticedError& noticed = *scans[worst].noticed;
  if (std::isfinite(noticed.most))
    return "the surest link of each scan would notice a shift of " +
           lengthText(noticed.most) + " or more (least at " + files[worst] + ")";
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << "no link of " << files[worst]
       << " would notice a shift along " << noticed.weakest.x() << ' '
       << noticed.weakest.y() << ' ' << noticed.weakest.z();
  return text.str();
}
} // namespace

std::string
exactnessOf(const MapVerification& map, const std::vector<std::string>& files)
{
  require(files.size() == map.scans.size(), "files", files.size(), "one per scan");
  const std::string bound = boundText(map.scans, files);
  const std::string noticed = noticedText(map.scans, files);
  return bound + (bound.empty() || noticed.empty() ? "" : "\n") + noticed;
}

} // namespace pcl6d
