// The port over which a test or a person steers a running simulation: a line of JSON in, a line of JSON out.
//
// Only on a loopback address, because whoever reaches it may do anything with the vehicles. A client that sends what is
// no JSON object is answered and not heard again: it speaks something else, a browser for instance, and what follows
// could look like a request by accident. Errors: open, as links. Thread: that of the link.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>
#include <tl/expected.hpp>

#include "io/link/link.hpp"

namespace godwit::sim {

// HOST:PORT, where HOST is localhost, 127.0.0.1 or the like, or [::1]. The error is a sentence that shows the form.
[[nodiscard]] tl::expected<io::link::uri, std::string> parse_control_place(std::string_view text);

class control_port {
public:
  static constexpr std::size_t max_line_bytes = 64 * 1024;
  static constexpr std::size_t max_clients = 8;
  // The longest answer is the state of a page of vehicles.
  static constexpr std::size_t queue_bytes = 256 * 1024;

  using answerer = std::function<nlohmann::json(const nlohmann::json& request)>;
  using status_callback = std::function<void(const io::link::link_status&)>;

  control_port(answerer answer, status_callback changed) : answer_(std::move(answer)), changed_(std::move(changed)) {}
  control_port(const control_port&) = delete;
  control_port& operator=(const control_port&) = delete;

  [[nodiscard]] tl::expected<void, std::string> open(const io::link::uri& where,
                                                     std::shared_ptr<io::link::io_thread> thread);
  [[nodiscard]] std::string description() const { return link_ ? link_->description() : std::string(); }

private:
  struct client {
    std::string line;          // what has come of it
    bool is_not_heard = false; // any more
  };

  void received(io::link::peer_id from, std::string_view bytes);
  [[nodiscard]] nlohmann::json answer_to(client& who, std::string_view line);
  void send(io::link::peer_id to, const nlohmann::json& answer);

  answerer answer_;
  status_callback changed_;
  std::map<io::link::peer_id, client> clients_; // at most max_clients: who leaves is taken out
  std::unique_ptr<io::link::link> link_;
};

} // namespace godwit::sim
