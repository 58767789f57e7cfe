#include "programs/common/heartbeat_sender.hpp"

#include <utility>

#include "io/mavlink/codec.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages/heartbeat.hpp"

namespace godwit::programs {

using namespace io::mavlink;

heartbeat_sender::heartbeat_sender(sender identity, std::optional<secret_key> key) : identity_(identity) {
  if (key)
    signer_.emplace(*std::move(key), signing_link, signing_time{0});
}

void heartbeat_sender::send(io::link::link& to, std::int64_t wall_ns) {
  const heartbeat beat{.type = number(mav_type::onboard_controller),
                       .autopilot = number(mav_autopilot::invalid),
                       .system_status = number(mav_state::active)};
  auto frame = encode(beat, identity_, sequence_++, signer_ ? signing::on : signing::off);
  if (signer_ && !signer_->sign(frame, wall_ns))
    return; // the clock is after the year 2104; unsigned it would be refused
  to.send(frame.span());
}

} // namespace godwit::programs
