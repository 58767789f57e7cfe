// Where envelopes meet CAF: the only file that says how one travels in a CAF message. For runtime/ alone.
#pragma once

#include <utility>

#include <caf/all.hpp>

#include "runtime/actor_ref.hpp"
#include "runtime/envelope.hpp"

// It never leaves the process, so CAF needs no way to write it down.
CAF_ALLOW_UNSAFE_MESSAGE_TYPE(godwit::runtime::envelope)

namespace godwit::runtime {

[[nodiscard]] caf::mailbox_element_ptr make_mail(caf::strong_actor_ptr sender, caf::message_id id, envelope content);

// Of the runtime itself: no sender that could be answered, no header.
template <class T>
[[nodiscard]] caf::mailbox_element_ptr make_internal_mail(T body) {
  return make_mail(nullptr, caf::make_message_id(), envelope::of({}, std::move(body)));
}

// Null: something that is not an envelope.
[[nodiscard]] const envelope* envelope_in(const caf::mailbox_element& element);

[[nodiscard]] inline caf::strong_actor_ptr strong(const actor_ref& ref) { return {ref.get(), true}; }
[[nodiscard]] inline actor_ref ref_of(const caf::strong_actor_ptr& actor) { return actor_ref(actor.get()); }

} // namespace godwit::runtime
