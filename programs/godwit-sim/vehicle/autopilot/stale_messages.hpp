// What PX4 may say just after it has taken another plan, before its parts agree: news of the old one.
//
// Which of them, and whether before or after the acknowledgement, is drawn for each change of a plan. Thread: one at
// a time. Source: messages of real flights.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <variant>

#include "io/mavlink/messages/mission.hpp"

namespace godwit::sim {

class stale_messages {
public:
  using message = std::variant<io::mavlink::mission_current, io::mavlink::mission_item_reached>;

  struct plan_before {
    int current = 0;
    std::optional<int> last_reached;
  };

  // NOW_SAYS: what is true of the new one.
  // The message to send before the acknowledgement, if there is one.
  [[nodiscard]] std::optional<message> on_switch(const plan_before& old, const io::mavlink::mission_current& now_says,
                                                 std::mt19937_64& random);
  // The one to send after it.
  [[nodiscard]] std::optional<message> take_late();

private:
  std::optional<message> late_;
};

} // namespace godwit::sim
