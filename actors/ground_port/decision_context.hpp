// Collects what one event leads to. Used by the core's own files only.
#pragma once

#include <span>
#include <utility>

#include "actors/ground_port/core.hpp"

namespace godwit::ground_port {

class core::decision_context {
public:
  decision_context(core& owner, instant when) : core_(owner), now(when) {}

  template <sent M>
  void send(io::link::peer_id to, const M& message) {
    send_as(to, message, core_.ourselves());
  }
  template <sent M>
  void send(mavlink::sender to, const M& message) {
    send(core_.stations_.way_to(to), message);
  }
  // A line that is down may be so because the peer refused: only something that is sent finds out that it listens.
  template <mavlink::message M>
  void send_as(io::link::peer_id to, const M& message, mavlink::sender who) {
    constexpr bool finds_out =
        M::message_id == mavlink::heartbeat::message_id || M::message_id == mavlink::mission_current::message_id;
    if (!core_.link_is_up_ && !finds_out) {
      ++core_.counts_.not_sent;
      return;
    }
    if (auto frame = core_.channel_.pack(message, who, now.wall_ns))
      done.emplace_back(transmission{to, *frame});
  }
  void send_as_said(io::link::peer_id to, const vehicle_link::relayed_frame& what) {
    const mavlink::sender who{what.system, what.component};
    auto frame = core_.link_is_up_ ? core_.channel_.pack_as_said(what.message, std::as_bytes(std::span(what.payload)),
                                                                 who, now.wall_ns)
                                   : std::nullopt;
    if (frame)
      done.emplace_back(transmission{to, *frame});
    else
      ++core_.counts_.not_sent;
  }
  void note(durable_event what) { done.emplace_back(std::move(what)); }
  void say(mavlink::mav_severity severity, std::string_view text, io::link::peer_id to = io::link::every_peer) {
    core_.texts_.put(severity, text, to);
  }

private:
  core& core_;

public:
  instant now;
  effects done;
};

} // namespace godwit::ground_port
