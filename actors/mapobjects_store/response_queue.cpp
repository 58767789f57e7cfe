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

} // namespace godwit::mapobjects_store
