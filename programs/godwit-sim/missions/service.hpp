// The missions service without sockets: a request goes in, an answer comes out, and the file has changed.
//
//   service_file is the only state. Each request is one transaction; a request that fails half way has changed nothing
//   and is answered with 500, which the contract takes for "ask again".
//
// A long poll for which there is nothing yet comes back as `waiting`: whoever holds it asks again when there is news,
// and at last with patience::none.
//
// Errors: as answers with a problem document. Thread: one at a time.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "programs/godwit-sim/missions/exchange.hpp"
#include "programs/godwit-sim/missions/fault.hpp"
#include "programs/godwit-sim/missions/service_file.hpp"

namespace godwit::sim::missions {

struct access_tokens {
  std::string vehicle; // may do everything
  std::string foreign; // known, and not for these missions; empty: there is none
};

struct waiting {
  std::uint64_t wait_s = 0;
};
using outcome = std::variant<answer, waiting>;

enum class patience {
  some, // a long poll may wait
  none  // it is over
};

class service {
public:
  service(service_file& file, access_tokens tokens) : file_(&file), tokens_(std::move(tokens)) {}

  // NOW_NS: since 1970.
  [[nodiscard]] outcome handle(const request& asked, std::int64_t now_ns, patience how_long = patience::some);

private:
  service_file* file_;
  access_tokens tokens_;
};

// Which call a request is, for faults and figures; also of one that will be refused.
[[nodiscard]] endpoint endpoint_of(const request& asked);

} // namespace godwit::sim::missions
