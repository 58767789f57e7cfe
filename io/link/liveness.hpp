// Keeps Asio from calling a handler whose owner is gone: what was waited for may be over, and its handler queued, when
// the owner ends.
//
//   timer_.async_wait(alive_.guard([this](const auto& cancelled) { ... }));
//
// Thread: the one that runs the handlers, also for the end of the owner; or any, when that thread has ended.
#pragma once

#include <memory>
#include <utility>

namespace godwit::io::link {

class liveness {
public:
  liveness() = default;
  ~liveness() { *alive_ = false; }
  liveness(const liveness&) = delete;
  liveness& operator=(const liveness&) = delete;

  template <class Handler>
  [[nodiscard]] auto guard(Handler handler) const {
    return [alive = alive_, handler = std::move(handler)](auto&&... arguments) mutable {
      if (*alive)
        handler(std::forward<decltype(arguments)>(arguments)...);
    };
  }

private:
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);
};

} // namespace godwit::io::link
