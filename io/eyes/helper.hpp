// The helper process godwit-eyes, as seen by who starts it: one at a time, each run with a number.
//
// A thread of its own starts it, reads what it says and ends it by SIGKILL: it keeps nothing that matters, and may
// hang. What is no message ends it too. No call here waits for it, nor for a process that does not die. Pictures lie in
// the slot, which outlives the runs. Errors: on_end, as a sentence. Thread: any; the callbacks come in the thread of
// the helper and must not block.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "io/eyes/messages.hpp"
#include "io/eyes/picture_slot.hpp"

namespace godwit::io::eyes {

struct helper_listener {
  std::function<void(std::uint32_t run, message said)> on_message;
  // Once for each run that was started, but for those that end() has ended or a later start() replaced.
  std::function<void(std::uint32_t run, std::string why)> on_end;
};

class helper {
public:
  // COMMAND: the program and its arguments. It has the socket as descriptor 3 and the slot as 4.
  [[nodiscard]] static tl::expected<std::shared_ptr<helper>, std::string> make(std::vector<std::string> command);
  ~helper(); // closes it
  helper(const helper&) = delete;
  helper& operator=(const helper&) = delete;

  // Before the first start().
  void attach(helper_listener listener);
  // Ends what runs before it.
  void start(std::uint32_t run, begin wanted);
  // What runs, if its number is not above UPTO: who has started the next one in the meantime keeps it.
  void end(std::uint32_t upto);
  // False: nothing runs, or there is no room; it is said anew later.
  bool send(const message& said);
  void close(); // ends what runs; nobody hears of anything any more
  [[nodiscard]] const picture_slot& slot() const;

private:
  struct parts;
  explicit helper(std::unique_ptr<parts> made);
  std::unique_ptr<parts> parts_;
};

} // namespace godwit::io::eyes
