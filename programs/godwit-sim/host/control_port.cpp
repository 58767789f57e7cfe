#include "programs/godwit-sim/host/control_port.hpp"

#include <nlohmann/json.hpp>

#include "programs/godwit-sim/text_forms.hpp"

namespace godwit::sim {
namespace {

using json = nlohmann::json;

bool is_loopback(std::string_view host) { return host == "localhost" || host == "::1" || host.starts_with("127."); }

json failure(const std::string& sentence) { return {{"ok", false}, {"error", sentence}}; }

} // namespace

tl::expected<io::link::uri, std::string> parse_control_place(std::string_view text) {
  const std::string form = " is no place for the control port; it is HOST:PORT with a loopback address, such as "
                           "127.0.0.1:14600, and port 0 for any free one";
  auto where = io::link::parse_uri("tcpin://" + std::string(text));
  if (!where || !is_loopback(where->host))
    return tl::make_unexpected(in_quotes(text) + form);
  return *std::move(where);
}

tl::expected<void, std::string> control_port::open(const io::link::uri& where,
                                                   std::shared_ptr<io::link::io_thread> thread) {
  io::link::link_callbacks callbacks{.received =
                                         [this](io::link::peer_id from, std::span<const std::byte> bytes, bool) {
                                           received(from, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
                                         },
                                     .changed = changed_,
                                     .left = [this](io::link::peer_id who) { clients_.erase(who); }};
  auto opened =
      io::link::open_link(where, std::move(callbacks),
                          {.send_queue_bytes = queue_bytes, .max_peers = max_clients, .thread = std::move(thread)});
  if (!opened)
    return tl::make_unexpected(std::move(opened.error()));
  link_ = *std::move(opened);
  return {};
}

void control_port::received(io::link::peer_id from, std::string_view bytes) {
  auto& who = clients_[from];
  while (!who.is_not_heard && !bytes.empty()) {
    const auto end = bytes.find('\n');
    who.line.append(bytes.substr(0, end));
    bytes.remove_prefix(end == std::string_view::npos ? bytes.size() : end + 1);
    if (who.line.size() > max_line_bytes) {
      who.is_not_heard = true;
      send(from, failure("a request is at most 65536 bytes long; connect again"));
    } else if (end != std::string_view::npos) {
      send(from, answer_to(who, std::exchange(who.line, {})));
    }
  }
  if (who.is_not_heard)
    who.line.clear();
}

json control_port::answer_to(client& who, std::string_view line) {
  const auto request = json::parse(line, nullptr, false);
  if (!request.is_object()) {
    who.is_not_heard = true;
    return failure("a request is a JSON object on one line, such as {\"do\": \"status\"}; connect again");
  }
  auto answer = answer_(request);
  if (const auto id = request.find("id"); id != request.end() && id->is_primitive())
    answer["id"] = *id;
  return answer;
}

void control_port::send(io::link::peer_id to, const json& answer) {
  const auto text = answer.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
  static_cast<void>(link_->send(std::as_bytes(std::span(text)), to));
}

} // namespace godwit::sim
