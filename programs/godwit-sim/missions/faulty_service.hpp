// The service with faults in front of it: still without sockets, so a fault can be tried without one.
//
// Thread: one at a time.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <variant>
#include <vector>

#include <boost/asio/io_context.hpp>

#include "io/http/server/responder.hpp"
#include "programs/godwit-sim/missions/exchange.hpp"
#include "programs/godwit-sim/missions/fault.hpp"
#include "programs/godwit-sim/missions/fault_book.hpp"
#include "programs/godwit-sim/missions/service.hpp"

namespace godwit::sim::missions {

// An answer, and how it goes over the wire. Thread: plain values.
struct delivery {
  answer what;
  std::chrono::nanoseconds delay{0};
  std::uint64_t bytes_per_s = 0;        // 0: as fast as it goes
  std::optional<std::size_t> cut_after; // reset after so many bytes of the body
  std::uint64_t padding = 0;            // spaces after the body
  bool is_lost = false;                 // reset before the first byte
};

// A request, and what will hit it; a long poll is held with it.
struct taken_call {
  request asked;
  endpoint where = endpoint::none;
  std::vector<fault::any> hits;
};

class faulty_service {
public:
  faulty_service(service& behind, fault_book& faults) : service_(&behind), faults_(&faults) {}

  [[nodiscard]] taken_call take(request asked);
  [[nodiscard]] std::variant<delivery, waiting> answer_to(const taken_call& call, std::int64_t now_ns,
                                                          patience how_long);

  // Puts in what was counted here.
  void count_into(service_figures& to) const;

private:
  service* service_;
  fault_book* faults_;
  std::map<endpoint, std::map<unsigned, std::uint64_t>> answers_;
  std::uint64_t lost_ = 0;
};

// What a fault does to an answer on its way. Thread: pure.
inline constexpr std::uint64_t huge_body_bytes = std::uint64_t{1} << 30;

// True: the service must not see the request, because nothing is to change.
[[nodiscard]] bool keeps_from_service(const fault::any& what);

// Faults of connections do nothing here.
void apply(const fault::any& what, delivery& to);

// Gives an answer to an HTTP server as its faults want it: late, slowly, cut off, much longer than it should be, or not
// at all. Here, so that the server itself has no faults to ask for.
//
// Thread: that of the context.
void deliver(boost::asio::io_context& io, io::http::responder to, delivery what);

} // namespace godwit::sim::missions
