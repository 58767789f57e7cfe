#include "runtime/address/mail_view.hpp"

#include "runtime/address/stable_address.hpp"
#include "runtime/system.hpp"

namespace godwit::runtime {

std::vector<mail_view> look_at_mail(const system& actors) {
  std::vector<mail_view> result;
  result.reserve(actors.declared().size());
  for (const auto& each : actors.declared()) {
    const auto& address = address_of(each.address);
    result.push_back({address.actor_name(), address.waiting(), address.counters()});
  }
  return result;
}

} // namespace godwit::runtime
