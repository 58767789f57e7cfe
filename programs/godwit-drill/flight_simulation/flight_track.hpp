// Where the vehicle of a flight was, ten times a second: what reports are held against. Thread: one.
#pragma once

#include <cstdint>
#include <vector>

#include "messages/mission/document.hpp"
#include "programs/godwit-sim/vehicle/vehicle.hpp"

namespace godwit::drill {

class flight_track {
public:
  static constexpr std::int64_t look_every_ns = 100'000'000;

  [[nodiscard]] bool is_due(std::int64_t now_ns) const { return now_ns >= next_look_ns_; }
  void look(const sim::vehicle& vehicle, std::int64_t now_ns);
  // It came so near to WHERE, heights apart, by UPTO_NS.
  [[nodiscard]] bool was_near(const mission::position& where, double metres, std::int64_t upto_ns) const;

private:
  struct place {
    std::int64_t at_ns = 0;
    double latitude_deg = 0;
    double longitude_deg = 0;
  };
  std::vector<place> places_;
  std::int64_t next_look_ns_ = 0;
};

} // namespace godwit::drill
