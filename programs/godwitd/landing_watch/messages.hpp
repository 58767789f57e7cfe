// What is said to the landing watch. Thread: plain values.
#pragma once

#include "io/fields/field_table.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "runtime/seam.hpp"

namespace godwit::landing_watch {

struct tick {
  static constexpr auto fields = io::table("landing_watch.tick");
};

using own_handle = runtime::mailbox<runtime::tells<io::mavlink::heartbeat>, runtime::tells<tick>>;

} // namespace godwit::landing_watch
