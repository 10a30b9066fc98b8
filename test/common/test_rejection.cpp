// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/packing.h>
#include <pcl6d/common/rejection.h>

#include <gtest/gtest.h>

#include <set>
#include <sstream>

using pcl6d::Rejection;
using pcl6d::RejectReason;
using pcl6d::Status;

namespace {
constexpr auto kLast = static_cast<int>(RejectReason::kPoseNotTested);
} // namespace

TEST(Rejection, EachReasonHasANameOfItsOwnAndWords)
{
  std::set<std::string> names;
  for (int k = 1; k <= kLast; ++k) {
    const auto reason = static_cast<RejectReason>(k);
    const std::string name = toString(reason);
    EXPECT_TRUE(names.insert(name).second) << name << " is the name of two";
    EXPECT_EQ(pcl6d::rejectReasonFromName(name), reason);
    Rejection rejection(reason, 2, 3);
    rejection.text = "some text";
    rejection.causes = {Rejection(RejectReason::kNoCycle)};
    const std::string words = toWords(rejection);
    EXPECT_FALSE(words.empty()) << name;
    EXPECT_EQ(words.find_first_of("{}"), std::string::npos) << words;
    EXPECT_TRUE(rejection);
  }
  EXPECT_THROW(pcl6d::rejectReasonFromName("because"), pcl6d::BadArgument);
}

TEST(Rejection, OfNoReasonIsAccepted)
{
  EXPECT_FALSE(Rejection());
  EXPECT_EQ(toWords(Rejection()), "");
  EXPECT_FALSE(Rejection::stated(""));
  EXPECT_STREQ(toString(RejectReason::kNone), "");
  EXPECT_FALSE(Rejection(static_cast<RejectReason>(1000)).reason ==
               RejectReason::kNone);
  EXPECT_EQ(toWords(Rejection(static_cast<RejectReason>(1000))), "") << "no reason";
}

TEST(Rejection, OfAMapHasACausePerLink)
{
  Rejection doubt(RejectReason::kScansContradict, 10);
  for (int k = 0; k < 10; ++k) {
    doubt.causes.emplace_back(RejectReason::kOfScans,
                              Rejection(RejectReason::kNoCycle));
    doubt.causes.back().text = std::to_string(k);
  }
  const std::string words = toWords(doubt);
  EXPECT_EQ(
      words.find("scans contradict each other: 0 (the links close no cycle), 1 ("), 0U);
  EXPECT_NE(words.find("7 (the links close no cycle) and 2 more"), std::string::npos)
      << words;
  EXPECT_EQ(pcl6d::wordsOfEach({doubt, Rejection()}),
            (std::vector<std::string>{words, ""}));
}

TEST(Rejection, ItsWordsHoldTheNumbers)
{
  Rejection second(RejectReason::kFitsElsewhere, 8.04, 179.6);
  second.text = "b";
  EXPECT_EQ(toWords(second), "fits as well 8.0 m away, turned by 180 deg, beside b");
  Rejection copies(RejectReason::kScansAreCopies, 3);
  copies.text = "a and b";
  EXPECT_EQ(toWords(copies),
            "scans are copies of earlier scans and verify no pose: a and b and 2 more");
  EXPECT_EQ(toWords(Rejection(RejectReason::kOverlapTooSmall, 0.0812, 0.1)),
            "overlap 0.0812 is less than 0.1");
  EXPECT_EQ(toWords(Rejection(RejectReason::kTooFewPairs, 12345, 20000)),
            "12345 pairs, fewer than 20000");
  EXPECT_EQ(toWords(Rejection(RejectReason::kIcpFailed, Status::kDiverged)),
            "ICP: diverged");
  EXPECT_EQ(toWords(Rejection(RejectReason::kLostTogether, 1)),
            "lost together with 1 other scan, matched to each other");
  EXPECT_EQ(toWords(Rejection(RejectReason::kShifted, 0.3, 0.1)),
            "surfaces ask for a shift of 0.3 m, 3 standard deviations");
  EXPECT_EQ(toWords(Rejection(RejectReason::kTooFewConfirmed, 0.095, 0.1)),
            "rays confirm only 9.5 % of the points");
  Rejection lost(RejectReason::kAgreementLost, 0.4, 0.5);
  EXPECT_EQ(toWords(lost), "agreement fell from 0.5 to 0.4");
  lost.deviations = 6;
  EXPECT_EQ(toWords(lost), "agreement fell from 0.5 to 0.4, 6 standard deviations");
}

TEST(Rejection, ItsCausesFollowInWords)
{
  const Rejection cause(RejectReason::kPatchesViolated, 7, 40);
  EXPECT_EQ(
      toWords(Rejection(RejectReason::kNoPoseInMap,
                        {RejectReason::kInconsistentLink, cause})),
      "in the map: another scan contradicts the best pose: rays go through 7 of 40 "
      "patches of surface");
  EXPECT_EQ(toWords(std::vector<Rejection>{{RejectReason::kNoCycle},
                                           {RejectReason::kNoNeighbours}}),
            "the links close no cycle; no scan has a neighbour");
}

TEST(Rejection, ComesBackFromItsBytes)
{
  Rejection rejection(RejectReason::kNotJoined,
                      {RejectReason::kIcpFailed, Status::kRankDeficient});
  rejection.text = "text";
  rejection.deviations = 2.5;
  pcl6d::Packer packer;
  packer(rejection);
  Rejection back;
  pcl6d::Unpacker unpacker(packer.bytes);
  unpacker(back);
  unpacker.finish();
  EXPECT_EQ(back, rejection);
  back.causes.front().status = Status::kOk;
  EXPECT_NE(back, rejection);
  std::ostringstream words;
  words << rejection;
  EXPECT_EQ(words.str(), toWords(rejection));
}
