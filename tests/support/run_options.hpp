// What whoever runs the tests can ask of them. Thread: any.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>

namespace godwit::tests {

// The seed of a random test: TEST_SEED, or a new one. The test prints it.
[[nodiscard]] inline std::uint64_t seed_of_this_run() {
  const char* given = std::getenv("TEST_SEED");
  return given != nullptr ? std::strtoull(given, nullptr, 10) : std::random_device{}();
}

// The first seed of a row of them: TEST_SEED, or 1.
[[nodiscard]] inline std::uint64_t first_seed() {
  const char* given = std::getenv("TEST_SEED");
  return given != nullptr ? std::strtoull(given, nullptr, 10) : 1;
}

// True with TEST_FULL=1, which asks for the long cases.
[[nodiscard]] inline bool is_full_run() {
  const char* full = std::getenv("TEST_FULL");
  return full != nullptr && std::string(full) == "1";
}

} // namespace godwit::tests
