// Words of operators that were given to the executor: which station waits for an answer, and what a repetition hears.
//
//   (none) ──begin()──> asked ──resolve()──> resolved, remembered for remembered_ns ──> forgotten
//
// One word of each station is under way, and its last one is remembered. A repetition is the same command with the same
// parameters, to the bit, from the same station; the confirmation of COMMAND_LONG may differ. While the executor is
// asked it hears IN_PROGRESS, then the answer that there was. Not kept across a crash: the station then repeats the
// word, and it does no harm to be asked twice; at worst the second one is refused, because it is done. Whoever asks the
// executor sees to it that each command is resolved, by its answer or by its silence. Pure. Times: ns, monotonic.
// Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "actors/ground_port/station_table.hpp"
#include "actors/ground_port/vehicle_role/order.hpp"

namespace godwit::ground_port {

class command_dedup {
public:
  // As many as are known at all.
  static constexpr std::size_t max_stations = station_table::max_stations;
  // MAVSDK sends up to 4 times at 0.5 s; whoever says the same again after that means it.
  static constexpr std::int64_t remembered_ns = 3'000'000'000;

  // WHAT repeats the last command of its station: what the station hears. Nothing: it is no repetition.
  [[nodiscard]] std::optional<mavlink::mav_result> heard_before(const vehicle_role::order& what,
                                                                std::int64_t now_ns) const;
  // No word of FROM is under way, and there is room for one.
  [[nodiscard]] bool may_begin(mavlink::sender from, std::int64_t now_ns) const;

  // Only when it may, and WHAT is no repetition. The number of the request to the executor.
  [[nodiscard]] std::uint64_t begin(const vehicle_role::order& what, std::int64_t now_ns);
  // The order that is answered with this; nothing: nobody waits for it.
  [[nodiscard]] std::optional<vehicle_role::order> resolve(std::uint64_t request, mavlink::mav_result result,
                                                           std::int64_t now_ns);

private:
  struct entry {
    vehicle_role::order what;
    std::uint64_t request = 0;
    std::optional<mavlink::mav_result> result = {}; // none: asked
    std::int64_t resolved_ns = 0;
  };
  [[nodiscard]] static bool is_forgotten(const entry& each, std::int64_t now_ns);
  [[nodiscard]] const entry* last_of(mavlink::sender from) const;

  std::vector<entry> entries_; // one for each station
  std::uint64_t last_request_ = 0;
};

} // namespace godwit::ground_port
