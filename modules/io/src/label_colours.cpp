// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/io/label_colours.h>

namespace pcl6d {
namespace {
using Colour = std::array<std::uint8_t, 3>;

struct LabelColour {
  const char* label;
  Colour colour;
};

constexpr std::array<LabelColour, 9> kKnown{{{"none", {150, 150, 150}},
                                             {"floor", {140, 86, 75}},
                                             {"ceiling", {174, 199, 232}},
                                             {"wall", {255, 221, 138}},
                                             {"door", {214, 39, 40}},
                                             {"table", {44, 160, 44}},
                                             {"stairs", {148, 103, 189}},
                                             {"ramp", {227, 119, 194}},
                                             {"window", {23, 190, 207}}}};

constexpr std::array<Colour, 8> kOthers{{{31, 119, 180},
                                         {255, 127, 14},
                                         {188, 189, 34},
                                         {152, 223, 138},
                                         {255, 152, 150},
                                         {197, 176, 213},
                                         {196, 156, 148},
                                         {158, 218, 229}}};
} // namespace

std::array<std::uint8_t, 3>
labelColour(const std::string& label)
{
  for (const auto& entry : kKnown)
    if (label == entry.label)
      return entry.colour;
  std::uint32_t sum = 0;
  for (const char letter : label)
    sum = 31 * sum + static_cast<unsigned char>(letter);
  return kOthers[sum % kOthers.size()];
}

} // namespace pcl6d
