// The command `link`: opens a link and shows what arrives, until it is told to stop.
//
// Messages or, with `stats`, tables go to the output: drawn over each other once a second on a terminal, else printed
// once at the end. The state of the link, refused signatures, hints and the tables at the end of a session that printed
// messages go to stderr. What ends a session: STOP becomes readable (Ctrl-C), `seconds` or `count` is reached, or
// nobody reads the output any more. It fails when `seconds` pass without one good frame, or when a recording lost
// frames. Errors: sentences on stderr. Thread: one, beside the link's own.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/link/link.hpp"
#include "io/link/uri.hpp"
#include "io/mavlink/scanner.hpp"
#include "io/mavlink/signing/secret_key.hpp"
#include "programs/common/command.hpp"
#include "programs/godwit-trace/message_printer.hpp"
#include "programs/godwit-trace/output.hpp"

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

// What a user may want to be told while nothing useful arrives: once each, a sentence that says what to try.
//
//   after 5 s     no byte                         is the sender sending here, is the line right
//                 bytes, and no frame             not MAVLink, or another baud rate
//   after 2 s     only MAVLink 1                  how to switch the autopilot to MAVLink 2
//
// Thread: a value; time comes from outside. Source: the parameters are those of ArduPilot and PX4.
class link_hints {
public:
  static constexpr std::chrono::seconds silent_after{5};
  static constexpr std::chrono::seconds v1_after{2};
  static constexpr std::uint64_t v1_frames_enough = 2; // one could be chance

  link_hints(const io::link::uri& where, bool has_heartbeat) : where_(where), has_heartbeat_(has_heartbeat) {}

  // ELAPSED since the beginning.
  [[nodiscard]] std::optional<std::string> due(std::chrono::milliseconds elapsed,
                                               const io::mavlink::scan_counters& heard);

private:
  io::link::uri where_;
  bool has_heartbeat_;
  bool told_v1_ = false;
  bool told_silence_ = false;
};

// What a link's thread hears, on its way to the thread that prints.
//
// Bounded: what does not fit is dropped and counted, so that a terminal that stands still costs no memory. The status
// of the link comes through the same queue, so that it stands between the bytes where it belongs. A descriptor becomes
// readable when there is something to take. Errors: the constructor throws if the system has no descriptor left.
// Thread: push from any, take by one.
struct heard_chunk {
  std::uint64_t time_us = 0; // since 1970, UTC, when it came
  bool is_datagram = false;
  std::vector<std::byte> bytes;
  std::optional<io::link::link_status> status; // then there are no bytes
  io::link::peer_id peer = io::link::only_peer;
};

class chunk_queue {
public:
  static constexpr std::size_t max_waiting_bytes = std::size_t{4} << 20; // a quarter of a minute of a busy link
  static constexpr std::size_t max_waiting_chunks = 65'536;

  chunk_queue();
  ~chunk_queue();
  chunk_queue(const chunk_queue&) = delete;
  chunk_queue& operator=(const chunk_queue&) = delete;

  void push(heard_chunk chunk);
  // All that waits, in its order.
  [[nodiscard]] std::vector<heard_chunk> take();

  [[nodiscard]] int descriptor() const { return descriptor_; }
  [[nodiscard]] std::uint64_t dropped_bytes() const;

private:
  mutable std::mutex mutex_;
  std::vector<heard_chunk> waiting_;
  std::size_t waiting_bytes_ = 0;
  std::uint64_t dropped_bytes_ = 0;
  int descriptor_;
};

} // namespace godwit::trace_tool
