// What a link lets through without a signature, and what may go out over it or into a log.
//
// Thread: values and pure functions. Source: the MAVLink guide, "Message Signing": which unsigned frames are accepted
// is up to each system; a key is sent over a secure link only, and never forwarded or logged.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "io/mavlink/messages/setup_signing.hpp"
#include "io/mavlink/messages/vehicle_status.hpp"

namespace godwit::io::mavlink {

inline constexpr std::size_t max_unsigned_ids = 8;

// Which frames are accepted unsigned on a link that has a key.
class unsigned_policy {
public:
  // None but RADIO_STATUS: a telemetry radio puts it into the stream, and has no key.
  constexpr unsigned_policy() : ids_{radio_status::message_id}, count_(1) {}

  // None but those with IDS. Empty if these are more than `max_unsigned_ids`.
  [[nodiscard]] static constexpr std::optional<unsigned_policy> only(std::span<const std::uint32_t> ids) {
    if (ids.size() > max_unsigned_ids)
      return std::nullopt;
    unsigned_policy policy;
    std::ranges::copy(ids, policy.ids_.begin());
    policy.count_ = ids.size();
    return policy;
  }

  // All: for a link on which signing is being introduced.
  [[nodiscard]] static constexpr unsigned_policy accept_all() {
    unsigned_policy policy;
    policy.all_ = true;
    return policy;
  }

  [[nodiscard]] constexpr bool lets_through(std::uint32_t id) const {
    const auto end = ids_.begin() + count_;
    return all_ || std::find(ids_.begin(), end, id) != end;
  }

private:
  std::array<std::uint32_t, max_unsigned_ids> ids_{};
  std::size_t count_ = 0;
  bool all_ = false;
};

// What the operator says of a link: `secure` is one on which nobody can listen, such as a cable or loopback. Being
// signed does not make it so, as signing hides nothing.
enum class link_security : std::uint8_t { open, secure };

// False for the frame that carries the key, unless the link is secure. To be asked before any frame is sent or
// forwarded.
[[nodiscard]] constexpr bool may_go_out(std::uint32_t id, link_security link) {
  return id != setup_signing::message_id || link == link_security::secure;
}

// False for the frame that carries the key. To be asked before a frame goes into a log or trace; from those that may,
// `strip_signature` takes the signature.
[[nodiscard]] constexpr bool may_be_logged(std::uint32_t id) { return id != setup_signing::message_id; }

} // namespace godwit::io::mavlink
