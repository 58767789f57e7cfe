// The service with faults in front of it: still without sockets, so a fault can be tried without one.
//
// Thread: one at a time.
#pragma once

#include <cstdint>
#include <map>
#include <variant>
#include <vector>

#include "programs/godwit-sim/missions/delivery.hpp"
#include "programs/godwit-sim/missions/fault_book.hpp"
#include "programs/godwit-sim/missions/service.hpp"

namespace godwit::sim::missions {

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

} // namespace godwit::sim::missions
