// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>

#include <gtest/gtest.h>

#include <string>

namespace pcl6d::test {

/** \brief Expects that the call throws an Error whose message holds the words. */
template <typename Error = BadArgument, typename Call>
void
expectRefused(Call call, const std::string& words)
{
  try {
    call();
    ADD_FAILURE() << "not refused: " << words;
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
  }
}

} // namespace pcl6d::test
