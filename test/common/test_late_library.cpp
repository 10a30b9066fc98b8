// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/late_library.h>

#include <gtest/gtest.h>

#include <string>
#include <typeinfo>

namespace {
std::string
errorOf(const std::string& library, const char* symbol)
{
  try {
    pcl6d::symbolOfLateLibrary("for tea", library, symbol);
  } catch (const pcl6d::IoFailed& e) {
    return e.what();
  }
  return "";
}
} // namespace

TEST(LateLibrary, ThatIsMissingIsNamedWithWhatBuildsIt)
{
  const std::string words = errorOf("pcl6d_teapot", "pour");
  EXPECT_EQ(words.rfind("for tea: ", 0), 0u) << words;
  EXPECT_NE(words.find("libpcl6d_teapot.so is missing; cmake --build build/release "
                       "--target pcl6d_teapot builds it"),
            std::string::npos)
      << words;
  EXPECT_EQ(words.find('\n'), std::string::npos) << words;
}

TEST(LateLibrary, ShowsWhatItHasAndNamesWhatItHasNot)
{
#ifdef PCL6D_SHARED_LIBS
  constexpr const char* kThere = "_ZTIN5pcl6d8IoFailedE"; // what typeid() gives
  EXPECT_EQ(pcl6d::symbolOfLateLibrary("for tea", "pcl6d_common", kThere),
            static_cast<const void*>(&typeid(pcl6d::IoFailed)));
  const std::string words = errorOf("pcl6d_common", "pour");
  EXPECT_EQ(
      words.rfind("for tea: the library libpcl6d_common.so is of another version", 0),
      0u)
      << words;
  EXPECT_NE(words.find("pour"), std::string::npos) << words;
#else
  GTEST_SKIP() << "static libraries";
#endif
}
