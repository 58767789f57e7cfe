// Which messages are wanted: by name, and by who sent them. Thread: a value.
#pragma once

#include <bitset>
#include <cstdint>
#include <span>

#include "io/mavlink/frame.hpp"
#include "programs/godwit-trace/name_filter.hpp"

namespace godwit::trace_tool {

class message_filter {
public:
  message_filter() = default;
  // Empty lists: all systems, all components.
  message_filter(name_filter names, std::span<const std::uint8_t> systems, std::span<const std::uint8_t> components);

  [[nodiscard]] bool wants_sender(io::mavlink::sender who) const {
    return systems_.test(who.system) && components_.test(who.component);
  }
  [[nodiscard]] bool wants(const io::mavlink::frame_view& frame) const {
    return wants_sender(frame.from()) && names_.wants(frame.id());
  }

private:
  name_filter names_;
  std::bitset<256> systems_ = std::bitset<256>().set();
  std::bitset<256> components_ = std::bitset<256>().set();
};

} // namespace godwit::trace_tool
