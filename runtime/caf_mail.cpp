#include "runtime/caf_mail.hpp"

namespace godwit::runtime {

actor_ref::actor_ref(caf::actor_control_block* actor) : actor_(actor) {
  if (actor_ != nullptr)
    caf::intrusive_ptr_add_ref(actor_);
}

actor_ref::actor_ref(const actor_ref& other) : actor_ref(other.actor_) {}

actor_ref::~actor_ref() {
  if (actor_ != nullptr)
    caf::intrusive_ptr_release(actor_);
}

caf::mailbox_element_ptr make_mail(caf::strong_actor_ptr sender, caf::message_id id, envelope content) {
  return caf::make_mailbox_element(std::move(sender), id, {}, std::move(content));
}

const envelope* envelope_in(const caf::mailbox_element& element) {
  const auto& content = element.content();
  return content.match_elements<envelope>() ? &content.get_as<envelope>(0) : nullptr;
}

} // namespace godwit::runtime
