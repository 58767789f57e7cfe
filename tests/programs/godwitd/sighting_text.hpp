// Lines of sightings for tests: each of another thing, a hundred metres from the one before. Thread: pure.
#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace godwit::test {

[[nodiscard]] inline std::string sighting_id(int number) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), "00000000-0000-4000-8000-%012d", number);
  return text.data();
}

[[nodiscard]] inline std::string sighting_lines(int count, int first = 0) {
  std::string result;
  for (int number = first; number < first + count; ++number) {
    std::array<char, 256> text{};
    const int row = number / 100;
    const int column = number % 100;
    std::snprintf(text.data(), text.size(),
                  R"({"id": "%s", "class_group": "vehicle", "latitude": %.6f, "longitude": %.6f, "confidence": 0.9, )"
                  R"("at": "2026-05-04T10:15:%02dZ"})",
                  sighting_id(number).c_str(), 47.39 + row * 0.002, 8.54 + column * 0.002, number % 60);
    result += text.data();
    result += '\n';
  }
  return result;
}

} // namespace godwit::test
