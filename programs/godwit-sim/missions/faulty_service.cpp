#include "programs/godwit-sim/missions/faulty_service.hpp"

#include <algorithm>

#include "programs/godwit-sim/missions/fault_effects.hpp"

namespace godwit::sim::missions {

taken_call faulty_service::take(request asked) {
  const auto where = endpoint_of(asked);
  return {std::move(asked), where, faults_->hit_by_call(where)};
}

std::variant<delivery, waiting> faulty_service::answer_to(const taken_call& call, std::int64_t now_ns,
                                                          patience how_long) {
  delivery made;
  if (std::ranges::none_of(call.hits, keeps_from_service)) {
    auto given = service_->handle(call.asked, now_ns, how_long);
    if (const auto* poll = std::get_if<waiting>(&given))
      return *poll;
    made.what = std::get<answer>(std::move(given));
  }
  for (const auto& each : call.hits)
    apply(each, made);
  if (made.is_lost)
    ++lost_;
  else
    ++answers_[call.where][made.what.status];
  return made;
}

void faulty_service::count_into(service_figures& to) const {
  to.answers = answers_;
  to.lost = lost_;
}

} // namespace godwit::sim::missions
