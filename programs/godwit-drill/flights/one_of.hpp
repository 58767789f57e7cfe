// How a flight draws from what it has. Thread: pure.
#pragma once

#include <array>
#include <cstddef>
#include <random>

namespace godwit::drill {

template <class T, std::size_t N>
T one_of(const std::array<T, N>& all, std::mt19937_64& random) {
  return all[random() % N];
}

} // namespace godwit::drill
