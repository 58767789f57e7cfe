// A message as who has said it, to be passed on: the same bytes, the same sender. Thread: plain functions.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include "io/mavlink/codec.hpp"
#include "io/mavlink/frame.hpp"
#include "messages/vehicle_link/types.hpp"

namespace godwit::ground_port::passing {

inline vehicle_link::relayed_frame as_said(std::uint32_t id, io::mavlink::sender who, io::mavlink::byte_view payload) {
  vehicle_link::relayed_frame result{id, who.system, who.component, {}};
  std::ranges::transform(payload, std::back_inserter(result.payload),
                         [](std::byte each) { return std::to_integer<std::uint8_t>(each); });
  return result;
}

inline vehicle_link::relayed_frame as_said(const io::mavlink::frame_view& frame) {
  return as_said(frame.id(), frame.from(), frame.payload());
}

template <io::mavlink::message M>
vehicle_link::relayed_frame as_said(const M& message, io::mavlink::sender who) {
  std::array<std::byte, io::mavlink::layout<M>::full_length> payload;
  io::mavlink::write_fields(message, payload.data());
  return as_said(M::message_id, who, payload);
}

} // namespace godwit::ground_port::passing
