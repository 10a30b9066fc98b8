// SPDX-License-Identifier: BSD-3-Clause
#include "common/options/option_table.h"
#include "fuzz/fuzz_target.h"
#include "fuzz/targets.h"

#include <pcl6d/io/natural_order.h>
#include <pcl6d/io/text.h>
#include <pcl6d/semantic_map/map_query.h>

#include <array>
#include <cmath>
#include <string_view>

namespace pcl6d::fuzz {

int
config(const std::uint8_t* data, std::size_t size)
{
  return readAsFile(".cfg", data, size, [](const auto& file) {
    double distance = 1;
    unsigned int threads = 0;
    std::optional<double> range;
    std::filesystem::path output;
    bool keeps = false;
    std::vector<std::string> names;
    app::OptionTable table("fuzz\n");
    table.group("Options");
    table.add("distance,d", &distance).above(0, "> 0", app::kFinite).help("[m]");
    table.addAs<int>("threads", &threads).within(0, 1024, "0 to 1024").help("number");
    table.addAuto("range", &range, 0.5).within(0, 1e6, "0 to 1e6").help("[m]");
    table.add("output,o", &output).help("file");
    table.add("keep", &keeps).help("switch");
    table.add("name", &names).composing().help("names");
    table.parse({"--config", file.string()});
    expect(distance > 0 && std::isfinite(distance), "a distance obeys its rule");
    expect(threads <= 1024, "a number of threads obeys its rule");
    expect(!range || (*range >= 0 && *range <= 0.5e6), "a range obeys its rule");
  });
}

int
numbers(const std::uint8_t* data, std::size_t size)
{
  return readAsText(data, size, [](const std::string& text) {
    double number = 0;
    if (text::parseNumber(text, number) && !std::isnan(number)) {
      double again = 0;
      expect(text::parseNumber(text::shortest(number), again) && again == number,
             "a number reads back");
    }
    int whole = 0;
    if (text::parseNumber(text, whole)) {
      const bool is_number = text::parseNumber(text, number);
      expect(is_number && number == whole, "a whole number is a number");
    }
    std::uint64_t count = 0;
    text::parseNumber(text, count);
    checkWords(text::quoted(text), text);
  });
}

int
natural_order(const std::uint8_t* data, std::size_t size)
{
  return readAsText(data, size, [](const std::string& text) {
    text::Lines lines(text);
    std::array<std::string, 3> names;
    for (auto& name : names)
      if (lines.next())
        name = lines.line();
    const auto& [a, b, c] = names;
    expect(!naturalLess(a, a), "no name stands before itself");
    expect(!(naturalLess(a, b) && naturalLess(b, a)), "one of two stands first");
    expect(a == b || naturalLess(a, b) || naturalLess(b, a), "names differ");
    expect(!(naturalLess(a, b) && naturalLess(b, c)) || naturalLess(a, c),
           "what stands before, stands before what follows");
  });
}

int
query(const std::uint8_t* data, std::size_t size)
{
  return readAsText(data, size, [](const std::string& text) { parseQuery(text); });
}

} // namespace pcl6d::fuzz
