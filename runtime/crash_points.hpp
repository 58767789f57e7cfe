// Places inside the handling of a message where a test or a drill can make an actor crash.
//
// The runtime calls hit() at each; whoever wants a crash throws from it, and the exception takes the same way as one of
// the handler. Production has none, and the call costs one comparison. Thread: hit() runs on the actor's thread.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string_view>

namespace godwit::runtime {

enum class crash_point : std::uint8_t {
  before_handler,  // nothing of the message has happened
  after_handler,   // the handler is done, what it sent is still held back
  after_commit,    // the handler's write was handed to the journal, its effects have not gone out
  before_dispatch, // the event is durable, its next effect goes out now
};

// So begins the reason of a crash that no code of the actor made: its message does not crash when it is replayed.
inline constexpr std::string_view planned_crash_words = "planned by the ";

struct injected_crash : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class crash_points {
public:
  crash_points() = default;
  crash_points(const crash_points&) = delete;
  crash_points& operator=(const crash_points&) = delete;
  virtual ~crash_points() = default;

  // ACTOR is the number of the stable address, MESSAGE the id of the message being handled.
  virtual void hit(crash_point point, std::uint32_t actor, std::uint64_t message) = 0;
};

} // namespace godwit::runtime
