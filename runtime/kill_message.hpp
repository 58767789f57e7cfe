// Ends an actor before it looks at any other mail. For runtime/ alone.
#pragma once

#include <caf/all.hpp>

namespace godwit::runtime {

[[nodiscard]] inline caf::mailbox_element_ptr kill_message(caf::actor_addr from = {}) {
  return caf::make_mailbox_element(nullptr, caf::make_message_id(caf::message_priority::high), {},
                                   caf::exit_msg{std::move(from), caf::exit_reason::kill});
}

} // namespace godwit::runtime
