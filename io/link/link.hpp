// A byte link to somebody: UDP, a serial line or TCP. It opens itself, tells why it is not up, and comes back by
// itself.
//
//   connecting --opened--> up --lost--> down --opened--> up ...
//        `-----failed--------------------^
//
// Down is tried again for ever: 100 ms after the loss, then after twice as long each time, up to a cap for each kind of
// link. udpout is different, because UDP has no connection: when the other side says that nobody listens there it is
// down, but goes on sending, and is up again at the first answer, or when it has sent for 2.5 s without a refusal.
//
// What is sent goes to the system in the calling thread where the system takes it. A stream keeps what it does not take
// in a bounded queue; what does not fit there as a whole is dropped, never cut off. When a stream is lost, what waits
// in its queue is thrown away: a command must not come out seconds later. UDP has no queue of its own: the system's
// send buffer is one.
//
// Errors: open_link fails for what can never work; everything else is a status. Thread: send, counters and description
// from any; the callbacks come in the link's own thread, one at a time. An exception out of a callback is a broken
// invariant and ends the process. A link is never destroyed inside one of its callbacks, nor inside those of a link
// with which it shares a thread. Source: POSIX and Linux man pages udp(7), tcp(7), termios(3), ioctl_tty(2).
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include <tl/expected.hpp>

#include "io/link/status.hpp"
#include "io/link/uri.hpp"

namespace godwit::io::link {

class io_thread;

// Totals since the link was made, but for the two marked "now". A chunk is a datagram, or what one read or send of a
// stream was about.
struct link_counters {
  std::uint64_t rx_bytes = 0;
  std::uint64_t rx_chunks = 0;
  std::uint64_t tx_bytes = 0;        // handed to the system; udpin, tcpin: once for each peer
  std::uint64_t tx_chunks = 0;       // the same
  std::uint64_t tx_dropped = 0;      // not up, queue full, refused by the system, or lost with the link
  std::uint64_t tx_no_peer = 0;      // udpin: nobody was heard lately; tcpin: nobody is there; any: no such peer
  std::uint64_t tx_queued_bytes = 0; // now
  std::uint64_t peers = 0;           // now
  std::uint64_t peers_forgotten = 0; // udpin: silent for too long
  std::uint64_t peers_evicted = 0;   // udpin: the longest silent one, for a new one when there were max_peers
  std::uint64_t peers_refused = 0;   // tcpin: turned away, because there were max_peers
  std::uint64_t open_failures = 0;   // tries to open that failed
  std::uint64_t losses = 0;          // times the link was up and went down
  std::uint64_t errors = 0;          // of the system, while reading and writing
  bool operator==(const link_counters&) const = default;
};

struct link_callbacks {
  // The bytes are valid during the call. IS_DATAGRAM: they arrived together, and nothing is missing between them.
  std::function<void(peer_id from, std::span<const std::byte> bytes, bool is_datagram)> received;
  // Called when phase or reason have changed, from the first "connecting" on. May be empty.
  std::function<void(const link_status&)> changed;
  // tcpin: the connection of this peer has ended; nothing more comes from it, and its number does not come back. May be
  // empty.
  std::function<void(peer_id who)> left = {};
};

// What the required time to come back allows at most: a cap above it is refused.
inline constexpr std::chrono::milliseconds max_serial_retry{2'000};
inline constexpr std::chrono::milliseconds max_network_retry{5'000};

struct link_options {
  std::chrono::milliseconds first_retry{100};
  // Looking for a device that is not there costs microseconds, and a line that is plugged in again must be up in 2 s.
  std::chrono::milliseconds serial_retry_cap{1'000};
  std::chrono::milliseconds udp_retry_cap{4'000};
  std::chrono::milliseconds tcp_retry_cap{4'000}; // from the start of one try to the start of the next
  std::chrono::milliseconds connect_timeout{3'000};
  // 57600 baud carry 5.7 kB/s: this is 11 s of the slowest usual line and the whole of a plan of 1000 items. What waits
  // longer is out of date, and whoever sends more is too fast for the line.
  std::size_t send_queue_bytes = 64 * 1024;
  // udpin, tcpin: ground stations and routers on one port; a seventeenth is a mistake or an attack.
  std::size_t max_peers = 16;
  // udpin: 30 heartbeats, long enough for a radio shadow, short enough not to send to a closed ground station for ever.
  std::chrono::milliseconds forget_peer_after{30'000};
  // None: a thread of its own. Else the link uses this one, which may serve many (io_thread.hpp).
  std::shared_ptr<io_thread> thread = nullptr;
};

class link {
public:
  link() = default;
  // Ends the link's thread, or its part in a shared one, and waits for that. What the system has not put on the line by
  // then is thrown away.
  virtual ~link() = default;
  link(const link&) = delete;
  link& operator=(const link&) = delete;

  // True: handed to the system or queued as a whole. False: dropped and counted. Never blocks on the line.
  virtual bool send(std::span<const std::byte> bytes, peer_id to = every_peer) = 0;
  [[nodiscard]] virtual link_counters counters() const = 0;
  // The local end as it is: the URI, with the real port where 0 was asked for, as soon as it is up.
  [[nodiscard]] virtual std::string description() const = 0;
};

// The callbacks may be called before this returns.
[[nodiscard]] tl::expected<std::unique_ptr<link>, std::string> open_link(const uri& where, link_callbacks callbacks,
                                                                         link_options options = {});

} // namespace godwit::io::link
