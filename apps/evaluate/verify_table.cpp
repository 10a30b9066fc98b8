// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/verify_report.h"

#include <pcl6d/io/text.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

namespace pcl6d::app {

namespace {
std::string
linkName(const LinkCheck& link, const VerifySource& source)
{
  return source.names[link.from] + " - " + source.names[link.to];
}

/** \return at most so many links, the most doubtful first */
std::vector<const LinkCheck*>
mostDoubtful(const std::vector<LinkCheck>& links, std::size_t rows)
{
  std::vector<const LinkCheck*> chosen;
  for (const LinkCheck& link : links)
    chosen.push_back(&link);
  std::stable_sort(
      chosen.begin(), chosen.end(), [](const LinkCheck* a, const LinkCheck* b) {
        return a->probability_wrong > b->probability_wrong;
      });
  chosen.resize(std::min(chosen.size(), rows));
  return chosen;
}

void
printLinks(const VerifySettings& s,
           const VerifySource& source,
           const MapVerification& map)
{
  const auto links = mostDoubtful(map.links, s.rows);
  if (links.empty())
    return;
  std::size_t width = 5;
  for (const LinkCheck* link : links)
    width = std::max(width, linkName(*link, source).size());
  const int w = static_cast<int>(width);
  std::printf("%-*s  %-10s  wrong by  contradicted  surfaces ask  deviation\n",
              w,
              "link",
              "trust");
  std::printf(
      "%-*s  %-10s  chance    patches       for a shift   of the place\n", w, "", "");
  for (const LinkCheck* link : links) {
    const std::string patches =
        std::to_string(link->contradicted) + " of " + std::to_string(link->patches);
    std::printf("%-*s  %-10s  %-8.1e  %-12s  %-10.3f m  %.3f m%s%s\n",
                w,
                linkName(*link, source).c_str(),
                toString(link->trust),
                link->probability_wrong,
                patches.c_str(),
                link->shift,
                link->deviation,
                link->open_directions > 0
                    ? (", " +
                       text::counted(static_cast<std::size_t>(link->open_directions),
                                     "motion") +
                       " open")
                          .c_str()
                    : "",
                link->reason.empty() ? "" : ("  " + link->reason).c_str());
  }
  if (map.links.size() > links.size())
    std::printf("and %zu more, less doubtful\n", map.links.size() - links.size());
}

std::string
sentenceOf(const MapVerification& map, bool is_pair)
{
  switch (map.trust) {
  case MapTrust::kGood:
    return is_pair ? "points and rays of both scans confirm the pose"
                   : "links that points and rays confirm tie every scan to the others, "
                     "and nothing contradicts the map";
  case MapTrust::kUnverified:
    return std::string("nothing contradicts the ") + (is_pair ? "pose" : "map") +
           ", but it is not confirmed";
  case MapTrust::kAmbiguous:
    return "a scan fits at two places";
  case MapTrust::kDoubtful:
    break;
  }
  return std::string("the ") + (is_pair ? "pose" : "map") + " is not to be trusted";
}
} // namespace

void
printVerification(const VerifySettings& s,
                  const VerifySource& source,
                  const MapVerification& map)
{
  printLinks(s, source, map);
  if (!s.isPair())
    std::printf(
        "%s: %zu good, %zu weak, %zu unverified, %zu wrong; links that are right "
        "contradict %.1f %% of their patches\n",
        text::counted(map.links.size(), "link").c_str(),
        map.count(LinkTrust::kGood),
        map.count(LinkTrust::kWeak),
        map.count(LinkTrust::kUnverified),
        map.count(LinkTrust::kWrong),
        100 * map.background);
  std::printf("%s: %s\n", toString(map.trust), sentenceOf(map, s.isPair()).c_str());
  for (const std::string& doubt : map.doubts)
    std::printf("  %s\n", doubt.c_str());
  std::fflush(stdout);
}

} // namespace pcl6d::app
