#include "runtime/gateway.hpp"

#include "runtime/caf_mail.hpp"

namespace godwit::runtime {

void gateway::send(const actor_ref& to, const message_type& type, message_body body) {
  const header head{(std::uint64_t{number_} << 41U) | ++count_, 0, 0, 0, number_};
  strong(to)->enqueue(make_mail(nullptr, caf::make_message_id(), {head, &type, std::move(body)}), nullptr);
}

} // namespace godwit::runtime
