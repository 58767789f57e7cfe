#include "actors/mapobjects_store/response_queue.hpp"

#include <utility>

namespace godwit::mapobjects_store {

bool response_queue::reserve() {
  const std::lock_guard guard(mutex_);
  if (asks_ >= max_asks)
    return false;
  ++asks_;
  return true;
}

void response_queue::give_back() {
  const std::lock_guard guard(mutex_);
  --asks_;
}

bool response_queue::put(ready_answer answer) {
  const std::lock_guard guard(mutex_);
  answers_.push_back(std::move(answer));
  return answers_.size() == 1;
}

std::optional<ready_answer> response_queue::take() {
  const std::lock_guard guard(mutex_);
  if (answers_.empty())
    return std::nullopt;
  std::optional result(std::move(answers_.front()));
  answers_.pop_front();
  --asks_;
  return result;
}

map_failure failure_of(map_errc code) {
  switch (code) {
  case map_errc::refused:
    return map_failure::refused;
  case map_errc::load_given_up:
    return map_failure::load_given_up;
  case map_errc::delivered:
    return map_failure::delivered;
  case map_errc::full:
  case map_errc::disk: // the writer itself tries again; this is a reader that could not be opened for now
    return map_failure::busy;
  case map_errc::closed:
  case map_errc::locked:
  case map_errc::missing:
  case map_errc::foreign:
  case map_errc::newer:
  case map_errc::corrupt:
  case map_errc::internal:
    break;
  }
  return map_failure::broken;
}

} // namespace godwit::mapobjects_store
