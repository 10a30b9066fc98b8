// SPDX-License-Identifier: BSD-3-Clause
#include "io/io_test.h"

#include <pcl6d/io/json_numbers.h>
#include <pcl6d/io/json_object.h>

#include <nlohmann/json.hpp>

#include <functional>
#include <limits>

using pcl6d::IoFailed;
using pcl6d::JsonValue;
using pcl6d::test::messageOf;

namespace {
JsonValue
parsed(const std::string& text)
{
  return pcl6d::parseJson(text, "a.json");
}

void
expectRefused(const std::string& text,
              const std::function<void(const JsonValue&)>& read,
              const std::string& message)
{
  const JsonValue json = parsed(text);
  EXPECT_EQ(messageOf<IoFailed>([&] { read(json); }), "a.json: " + message);
}
} // namespace

TEST(JsonValue, ReadsMembersThatMayBeMissing)
{
  const JsonValue json =
      parsed(R"({"a": 1.5, "b": 3, "c": "x", "d": [1, 2], "e": [1, 2, 3], "f": null})");
  double a = 0;
  int b = 0, missing = 7;
  std::uint64_t seed = 0;
  std::string c;
  Eigen::Vector2d d;
  Eigen::Vector3d e;
  json.read("a", a);
  json.read("b", b);
  json.read("b", seed);
  json.read("c", c);
  json.read("d", d);
  json.read("e", e);
  json.read("g", missing);
  EXPECT_EQ(a, 1.5);
  EXPECT_EQ(b, 3);
  EXPECT_EQ(seed, 3u);
  EXPECT_EQ(c, "x");
  EXPECT_EQ(d, Eigen::Vector2d(1, 2));
  EXPECT_EQ(e, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(missing, 7);
  EXPECT_EQ(json.get<double>("a"), 1.5);
  EXPECT_TRUE(json.member("f"));
  EXPECT_FALSE(json.find("f"));
  EXPECT_FALSE(json.member("g"));
}

TEST(JsonValue, NamesTheFileAndTheMemberThatIsWrong)
{
  const auto readA = [](const JsonValue& json) {
    double a = 0;
    json.read("a", a);
  };
  expectRefused(R"({"a": "x"})", readA, "/a: \"x\" is not a number");
  expectRefused(R"({"a": null})", readA, "/a: null is not a number");
  expectRefused("[1]", readA, "/: [1] is no object {...}");
  expectRefused(
      "{}",
      [](const JsonValue& json) { json.get<double>("a"); },
      "/: key 'a' is missing");
  expectRefused(R"({"a": [1, 2, 3]})",
                [](const JsonValue& json) { json.get<Eigen::Vector2d>("a"); },
                "/a: expected 2 numbers, got 3");
  expectRefused(R"({"a": [1, 1e10]})",
                [](const JsonValue& json) { json.get<Eigen::Vector2d>("a"); },
                "/a: [1,10000000000.0], but must be two numbers below 1e9");
  expectRefused(R"({"a": {}})",
                [](const JsonValue& json) { (json / "a").fail("b", "is too small"); },
                "/a/b: is too small");
}

TEST(JsonValue, RefusesKeysThatAreNotKnown)
{
  parsed(R"({"a": 1})").allow({"a", "b"});
  expectRefused(R"({"a": 1, "c": 2})",
                [](const JsonValue& json) {
                  json.allow({"a", "b"});
                },
                "/: unknown key 'c'");
}

TEST(JsonNumbers, AreNullWithoutAFiniteNumber)
{
  EXPECT_EQ(pcl6d::finiteOrNull(1.5), 1.5);
  EXPECT_TRUE(pcl6d::finiteOrNull(std::numeric_limits<double>::infinity()).is_null());
  EXPECT_EQ(pcl6d::numberOrNull(2), 2.0);
  EXPECT_TRUE(pcl6d::numberOrNull({}).is_null());
}
