// The control socket: a line of JSON in, a line of JSON out, for a few clients at once.
//
//   client ──line──> read_request ──ticket──> ask() ... response_queue ──line──> client
//
// A Unix socket of mode 0600, so that only the user under whom godwitd runs reaches it. A file that a killed godwitd
// left there is replaced; one on which somebody still listens, or may, is an error. At the end it is removed if it is
// still ours. Without descriptors nobody is let in for a second. Each client has one request under way; the
// next line waits. Who sends a line that is too long, reads nothing, or says nothing for a while is closed: nobody can
// hold up the others, and nobody here ever waits for a client. Errors: open, as sentences. Thread: one of its own; open
// and the destructor by the owner; ASK is called in the thread and must be quick. Source: unix(7).
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include <sys/types.h>
#include <tl/expected.hpp>

#include "io/link/descriptor.hpp"
#include "programs/godwitd/control/messages.hpp"
#include "programs/godwitd/control/response_queue.hpp"

namespace godwit::control {

struct server_limits {
  std::size_t max_clients = 8;
  std::size_t max_line_bytes = 4 * 1024;
  std::size_t max_unread_bytes = 256 * 1024; // answers that a client does not take
  std::chrono::milliseconds answer_timeout{5'000};
  std::chrono::milliseconds idle_timeout{60'000};
};

// Which file it is, whatever its name. Zero: none.
struct file_identity {
  dev_t device = 0;
  ino_t number = 0;
  bool operator==(const file_identity&) const = default;
};

class server {
public:
  using asker = std::function<void(control_request asked)>;

  // ANSWERS are those to what ASK was called with.
  [[nodiscard]] static tl::expected<std::unique_ptr<server>, std::string>
  open(const std::string& path, std::shared_ptr<response_queue> answers, asker ask, server_limits limits = {});
  // The file is gone afterwards.
  ~server();
  server(const server&) = delete;
  server& operator=(const server&) = delete;

private:
  using clock = std::chrono::steady_clock;

  struct client {
    io::link::descriptor socket;
    std::string in;
    std::string out;
    std::uint64_t ticket = 0;   // of the request under way; 0: none
    clock::time_point deadline; // for the answer, or for the next word
    bool is_leaving = false;    // when all is sent
  };

  server(std::string path, io::link::descriptor listening, io::link::descriptor stop,
         std::shared_ptr<response_queue> answers, asker ask, server_limits limits);

  void run();
  [[nodiscard]] int wait_ms() const;
  void accept_one();
  [[nodiscard]] bool read_from(client& who); // false: it is gone
  [[nodiscard]] bool write_to(client& who);  // false: it is gone
  void next_request(client& who);
  void say(client& who, std::string line);
  void turn_away(client& who, const std::string& why);
  void hand_out_answers();
  [[nodiscard]] bool look_at_time(client& who); // false: its time is over
  [[nodiscard]] bool has_to_go(const client& who) const;

  const std::string path_;
  const file_identity file_;
  clock::time_point lets_in_again_{};
  io::link::descriptor listening_;
  io::link::descriptor stop_;
  std::shared_ptr<response_queue> answers_;
  asker ask_;
  const server_limits limits_;
  std::uint64_t last_ticket_ = 0;
  std::list<client> clients_;
  std::thread thread_;
};

} // namespace godwit::control
