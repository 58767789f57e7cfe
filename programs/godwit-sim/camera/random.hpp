// Numbers that look random and are the same on each machine for the same seed. Thread: one object, one thread.
// Source: splitmix64 (Steele, Lea, Flood 2014).
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace godwit::sim::camera {

[[nodiscard]] constexpr std::uint64_t scrambled(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

// A seed of its own for each use of SEED.
[[nodiscard]] constexpr std::uint64_t seed_for(std::uint64_t seed, std::uint64_t use) {
  return scrambled(scrambled(seed) ^ (use * 0xd6e8feb86659fd93U));
}

class random_source {
public:
  explicit random_source(std::uint64_t seed) : state_(seed) {}

  [[nodiscard]] std::uint64_t next() {
    const std::uint64_t result = scrambled(state_);
    state_ += 0x9e3779b97f4a7c15U;
    return result;
  }
  // 0 or more, below 1.
  [[nodiscard]] double uniform() { return static_cast<double>(next() >> 11U) * 0x1p-53; }
  [[nodiscard]] double between(double least, double most) { return least + (most - least) * uniform(); }
  // 0 to COUNT - 1.
  [[nodiscard]] int below(int count) { return static_cast<int>(uniform() * count); }
  // Mean 0, standard deviation 1 (Box and Muller).
  [[nodiscard]] double gaussian() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

private:
  std::uint64_t state_;
};

} // namespace godwit::sim::camera
