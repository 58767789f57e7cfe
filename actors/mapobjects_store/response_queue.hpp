// Answers on their way from the writer's thread to the actor, in the order in which they became true.
//
// It outlives the incarnations of the actor. An answer that nobody waits for any more is dropped by whoever takes it.
// Thread: any.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>

#include "actors/mapobjects_store/answers.hpp"

namespace godwit::mapobjects_store {

struct ready_answer {
  std::uint64_t request_id = 0; // 0 = the actor's own question
  any_answer what;
};

class response_queue {
public:
  // Asks that were handed over and whose answer was not taken yet. The writer's own queue is as long.
  static constexpr std::size_t max_asks = 10'000;

  // Before an ask is handed over; false: there are max_asks.
  [[nodiscard]] bool reserve();
  // It was not taken after all.
  void give_back();

  // True when the box was empty: whoever takes has to be woken.
  [[nodiscard]] bool put(ready_answer answer);

  [[nodiscard]] std::optional<ready_answer> take();

private:
  std::mutex mutex_;
  std::size_t asks_ = 0;
  std::deque<ready_answer> answers_;
};

} // namespace godwit::mapobjects_store
