// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/map_verification.h>
#include <pcl6d/common/name_table.h>

#include <algorithm>

namespace pcl6d {

namespace {
constexpr Named<LinkTrust> kLinkTrusts[] = {{LinkTrust::kGood, "good"},
                                            {LinkTrust::kWeak, "weak"},
                                            {LinkTrust::kUnverified, "unverified"},
                                            {LinkTrust::kWrong, "wrong"}};
constexpr Named<MapTrust> kMapTrusts[] = {{MapTrust::kGood, "good"},
                                          {MapTrust::kDoubtful, "doubtful"},
                                          {MapTrust::kAmbiguous, "ambiguous"},
                                          {MapTrust::kUnverified, "unverified"}};
} // namespace

const char*
toString(LinkTrust trust)
{
  return nameOf(kLinkTrusts, trust);
}

LinkTrust
linkTrustFromName(const std::string& name)
{
  return fromName(kLinkTrusts, "trust of a link", name, WordList::kOneOf);
}

const char*
toString(MapTrust trust)
{
  return nameOf(kMapTrusts, trust);
}

MapTrust
mapTrustFromName(const std::string& name)
{
  return fromName(kMapTrusts, "trust of a map", name, WordList::kOneOf);
}

std::size_t
MapVerification::count(LinkTrust trust_of_link) const
{
  return static_cast<std::size_t>(
      std::count_if(links.begin(), links.end(), [&](const LinkCheck& link) {
        return link.trust == trust_of_link;
      }));
}

} // namespace pcl6d
