// What the control socket asks of the desk. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>

#include "io/fields/field_table.hpp"

namespace godwit::control {

enum class request_kind { status, outbox_retry };

constexpr auto enum_names(request_kind) {
  return io::names<request_kind>({{request_kind::status, "status"}, {request_kind::outbox_retry, "outbox_retry"}});
}

struct control_request {
  std::uint64_t ticket = 0; // whom the answer is for
  request_kind what = request_kind::status;
  std::string key; // outbox_retry: of one row; empty: all
  static constexpr auto fields =
      io::table("control.request", io::field("ticket", &control_request::ticket),
                io::field("what", &control_request::what), io::field("key", &control_request::key));
};

} // namespace godwit::control
