// When an effect of a durable actor goes out. The type of the effect says it:
//
//   struct command {
//     static constexpr auto goes_out = runtime::effect_kind::at_once;
//     ...
//   };
//
// An effect whose type says nothing is durable. Thread: plain values.
#pragma once

#include <concepts>
#include <cstdint>

namespace godwit::runtime {

enum class effect_kind : std::uint8_t {
  durable,      // after the commit, with an id, again after a crash until each receiver has confirmed it
  after_commit, // when this write of the actor and all earlier ones are on the disk; gone with a crash
  at_once,      // before the write; gone with a crash
};

template <class E>
inline constexpr effect_kind kind_of = [] {
  if constexpr (requires {
                  { E::goes_out } -> std::convertible_to<effect_kind>;
                })
    return E::goes_out;
  else
    return effect_kind::durable;
}();

} // namespace godwit::runtime
