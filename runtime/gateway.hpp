// The way into the actors for a thread that is not one: a port's I/O thread, a signal handler's thread, a test.
// Thread: one gateway for each thread; copies of handles are free.
#pragma once

#include <cstdint>
#include <utility>

#include <caf/all.hpp>

#include "runtime/mail.hpp"
#include "runtime/seam.hpp"

namespace godwit::runtime {

class gateway {
public:
  explicit gateway(std::uint32_t number) : number_(number) {}

  template <class Handle, class T>
  requires accepts<Handle, T>
  void tell(const Handle& to, T body) {
    caf::actor_cast<caf::strong_actor_ptr>(to)->enqueue(
        caf::make_mailbox_element(nullptr, caf::make_message_id(), {}, mail<T>{stamp(), std::move(body)}), nullptr);
  }

private:
  header stamp() { return {(std::uint64_t{number_} << 41U) | ++count_, 0, 0, 0, number_}; }

  std::uint32_t number_;
  std::uint64_t count_ = 0;
};

} // namespace godwit::runtime
