// The command `link`: opens a link and shows what arrives, until it is told to stop.
//
// Messages or, with `stats`, tables go to the output: drawn over each other once a second on a terminal, else printed
// once at the end. The state of the link, refused signatures, hints and the tables at the end of a session that printed
// messages go to stderr. What ends a session: STOP becomes readable (Ctrl-C), `seconds` or `count` is reached, or
// nobody reads the output any more. It fails when `seconds` pass without one good frame, or when a recording lost
// frames. Errors: sentences on stderr. Thread: one, beside the link's own.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "io/link/link.hpp"
#include "io/mavlink/signing/secret_key.hpp"
#include "programs/common/exit_code.hpp"
#include "programs/godwit-trace/output.hpp"
#include "programs/godwit-trace/print_options.hpp"

namespace godwit::trace_tool {

using programs::exit_code;

struct link_keys {
  io::mavlink::secret_key to_verify;
  io::mavlink::secret_key to_sign;
};

struct link_session_options {
  io::link::uri where;
  print_options print;
  std::optional<std::chrono::milliseconds> seconds;
  std::optional<std::uint64_t> count;              // of printed messages
  std::string tlog;                                // records into this file if not empty
  std::optional<link_keys> keys;                   // none: signatures are not looked at
  std::optional<io::mavlink::sender> heartbeat_as; // none: nothing is sent
};

// STOP is a descriptor that is polled and not read.
[[nodiscard]] exit_code run_link(link_session_options options, console& to, int stop);

} // namespace godwit::trace_tool
