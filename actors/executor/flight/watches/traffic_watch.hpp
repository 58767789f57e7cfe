// Tells people of another aircraft that comes close to a vehicle that is armed, and of the autopilot's own warnings:
// once as it begins, once when it is over. Nothing is sent to the vehicle because of it.
//
//   not told ──close──> told ──not close, or not heard of, for apart_for_ns──> not told
//
// A new incarnation tells again what it finds. Pure. Thread: one at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "actors/executor/flight/flight_context.hpp"

namespace godwit::executor {

class traffic_watch {
public:
  static constexpr std::int64_t look_period_ns = 500'000'000;
  // One that flies along the limit is told of once.
  static constexpr std::int64_t apart_for_ns = 15'000'000'000;
  static constexpr std::size_t max_told = 8; // at a time, the nearest first: nobody reads more

  explicit traffic_watch(const flight_context& flight) : flight_(flight) {}

  // To be asked often. Adds what people are told.
  void look(effects& out, instant now);

private:
  struct told {
    std::string key;
    std::string end;           // the sentence for it
    std::int64_t close_ns = 0; // when it was so last
  };

  void on_close(effects& out, const std::string& key, const std::string& end, const std::string& sentence, instant now);

  const flight_context& flight_;
  std::vector<told> told_;
  std::int64_t looked_ns_ = 0;
};

} // namespace godwit::executor
