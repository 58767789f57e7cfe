// The way into the actors for a thread that is not one: a port's I/O thread, a signal handler's thread, a test.
// Thread: one gateway for each thread; copies of handles are free.
#pragma once

#include <cstdint>
#include <utility>

#include "runtime/envelope.hpp"
#include "runtime/seam.hpp"

namespace godwit::runtime {

class gateway {
public:
  gateway(std::uint32_t number, std::uint64_t ids_before) : number_(number), count_(ids_before) {}

  template <class Handle, class T>
  requires accepts<Handle, T>
  void tell(const Handle& to, T body) { send(to.ref(), type_of<T>(), message_body::of(std::move(body))); }

private:
  void send(const actor_ref& to, const message_type& type, message_body body);

  std::uint32_t number_;
  std::uint64_t count_;
};

} // namespace godwit::runtime
