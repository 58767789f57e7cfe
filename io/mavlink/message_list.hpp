// A list of message types, and the way from the id of a frame to the type.
//
// `visit<List>(frame, f)` decodes the frame and calls f(const M&) if its id is in the list, through one table lookup
// and one jump. Thread: pure.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "io/mavlink/codec.hpp"

namespace godwit::io::mavlink {

template <message... Ms>
struct message_list {
  static constexpr std::size_t size = sizeof...(Ms);
  static constexpr std::uint32_t max_id = std::max({Ms::message_id...});

  static constexpr std::uint8_t none = 0xFF;
  static_assert(size < none);

  // Place in the list by id; `none` for ids that are not in it.
  static constexpr auto places = [] {
    std::array<std::uint8_t, max_id + 1> result{};
    result.fill(none);
    std::uint8_t place = 0;
    ((result[Ms::message_id] = place++), ...);
    return result;
  }();

  [[nodiscard]] static constexpr std::uint8_t place_of(std::uint32_t id) { return id <= max_id ? places[id] : none; }
  [[nodiscard]] static constexpr bool contains(std::uint32_t id) { return place_of(id) != none; }

  // Calls F.template operator()<M>() for each type of the list, in its order.
  template <class F>
  static constexpr void for_each(F&& f) {
    (f.template operator()<Ms>(), ...);
  }

  // False, and F is not called, if the id of FRAME is not in the list.
  template <class F>
  static bool visit(const frame_view& frame, F&& f) {
    using handler = void (*)(const frame_view&, F&);
    static constexpr std::array<handler, size> handlers{
        +[](const frame_view& each, F& callback) { callback(decode<Ms>(each)); }...};
    const auto place = place_of(frame.id());
    if (place == none)
      return false;
    handlers[place](frame, f);
    return true;
  }
};

} // namespace godwit::io::mavlink
