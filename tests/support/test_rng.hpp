// One number, and all that a test draws from it. Thread: one owner.
#pragma once

#include <cstdint>
#include <random>

namespace godwit::tests {

class test_rng {
public:
  explicit test_rng(std::uint64_t seed) : random_(seed) {}

  int between(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  bool one_in(int n) { return between(1, n) == 1; }
  double up_to(double high) { return std::uniform_real_distribution<>(0, high)(random_); }

private:
  std::mt19937_64 random_;
};

} // namespace godwit::tests
