// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/verify/verify_report.h"

#include <pcl6d/io/text.h>
#include <pcl6d/run/verification_io.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace pcl6d::app {

namespace {
std::string
linkName(const LinkCheck& link, const VerifySource& source)
{
  return source.names[link.from] + " - " + source.names[link.to];
}

/** \return at most `rows` links, the most doubtful first */
std::vector<const LinkCheck*>
mostDoubtful(const std::vector<LinkCheck>& links, std::size_t rows)
{
  std::vector<const LinkCheck*> chosen;
  for (const LinkCheck& link : links)
    chosen.push_back(&link);
  std::stable_sort(
      chosen.begin(), chosen.end(), [](const LinkCheck* a, const LinkCheck* b) {
        return std::make_pair(a->probability_wrong, a->contradicted) >
               std::make_pair(b->probability_wrong, b->contradicted);
      });
  chosen.resize(std::min(chosen.size(), rows));
  return chosen;
}

/** \return the reason why a link is not consistent, and open questions */
std::string
remarkOn(const LinkCheck& link)
{
  if (link.open_directions == 0)
    return toWords(link.rejection);
  return toWords(link.rejection) + (link.rejection ? "; " : "") +
         std::to_string(link.open_directions) + " of 6 motions open";
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
  std::printf("%-*s  trust       P(wrong)  contradicted  shift [m]  deviation [m]\n",
              w,
              "link");
  for (const LinkCheck* link : links) {
    const std::string patches =
        std::to_string(link->contradicted) + " of " + std::to_string(link->patches);
    std::printf("%-*s  %-10s  %-8.2g  %12s  %9.3f  %13.3f  %s\n",
                w,
                linkName(*link, source).c_str(),
                toString(link->trust),
                link->probability_wrong,
                patches.c_str(),
                link->shift,
                link->deviation,
                remarkOn(*link).c_str());
  }
  if (map.links.size() > links.size())
    std::printf("and %zu more, less doubtful\n", map.links.size() - links.size());
}

std::string
sentenceOf(const MapVerification& map, bool is_pair)
{
  switch (map.trust) {
  case MapTrust::kGood:
    return is_pair
               ? "points and rays of both scans confirm the pose"
               : "consistent links connect every scan, and no link contradicts the map";
  case MapTrust::kUnverified:
    return std::string("nothing contradicts the ") + (is_pair ? "pose" : "map") +
           ", but the pose is not verified";
  case MapTrust::kAmbiguous:
    return "a scan fits at two places";
  case MapTrust::kDoubtful:
    break;
  }
  return std::string("the ") + (is_pair ? "pose" : "map") + " is not to be trusted" +
         (is_pair && map.count(LinkTrust::kWrong) == 0
              ? ": no test tells right from wrong"
              : "");
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
  for (const std::string& doubt : wordsOfEach(map.doubts))
    std::printf("  %s\n", doubt.c_str());
  const std::string exactness = exactnessOf(map, source.names);
  if (!exactness.empty())
    std::printf("%s\n", exactness.c_str());
  std::fflush(stdout);
}

} // namespace pcl6d::app
