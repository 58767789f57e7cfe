// Plays the helper process with its vices, by the name of one: good, garbage, exit, silent.
#include <cstdlib>
#include <string_view>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "io/eyes/channel.hpp"
#include "io/eyes/picture_slot.hpp"

int main(int argc, char** argv) {
  using namespace godwit::io;
  const std::string_view vice = argc > 1 ? argv[1] : "";
  if (vice == "exit")
    return 7;
  auto slot = eyes::picture_slot::attach(link::descriptor(4)).value();
  eyes::channel daemon{link::descriptor(3)};
  if (vice == "garbage")
    (void)!::send(3, "not a message at all", 20, 0);
  const std::byte picture{1};
  (void)slot.publish({&picture, 1}, 5, 64, 48);
  while (vice == "silent")
    ::pause();
  for (;;) {
    pollfd socket{3, POLLIN, 0};
    (void)::poll(&socket, 1, -1);
    const auto read = daemon.receive();
    if (!read || read->is_closed)
      return 0;
    if (!read->said)
      continue;
    eyes::status now; // each message is answered with the kind that it had
    now.reason = std::to_string(read->said->index());
    (void)daemon.send(now);
  }
}
