#include "programs/godwit-sim/missions/service_server.hpp"

#include <chrono>
#include <utility>
#include <vector>

#include "io/http/content_coding.hpp"
#include "programs/godwit-sim/missions/faulty_service.hpp"
#include "programs/godwit-sim/missions/route.hpp"

namespace godwit::sim::missions {
namespace {

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

request request_of(io::http::server_request&& asked) {
  const auto header = [&](std::string_view name) { return std::string(asked.find(name)); };
  auto accept_encoding = header("Accept-Encoding");
  return {.method = std::move(asked.method),
          .target = std::move(asked.target),
          .authorization = header("Authorization"),
          .content_type = header("Content-Type"),
          .body = std::move(asked.body),
          .accept_encoding = std::move(accept_encoding)};
}

// As a service behind a proxy does it: what is worth it, for who accepts it. What a fault cuts or pads stays plain.
void compress(delivery& what, std::string_view accept_encoding) {
  constexpr std::size_t is_worth_it = 1024;
  const auto how = io::http::chosen_coding(accept_encoding);
  if (!how || what.what.body.size() < is_worth_it || what.cut_after || what.padding != 0)
    return;
  what.what.body = io::http::compressed(what.what.body, *how);
  what.what.headers.push_back({"Content-Encoding", std::string(io::http::coding_name(*how))});
  what.what.headers.push_back({"Vary", "Accept-Encoding"});
}

// A line for people.
std::string line_of(const taken_call& call, const delivery& what) {
  constexpr std::size_t shown = 200; // characters of a target
  return call.asked.method.substr(0, shown) + " " + call.asked.target.substr(0, shown) + " " +
         (what.is_lost ? std::string("no answer") : std::to_string(what.what.status)) +
         (call.hits.empty() ? "" : ", hit by a fault");
}

} // namespace

service_server::service_server(boost::asio::io_context& io, io::http::server_settings set, faulty_service& answering,
                               fault_book& faults, server_tls tls, teller tell)
    : io_(io), answering_(answering), tls_(std::move(tls)), teller_(std::move(tell)),
      server_(io, std::move(set),
              {.handle =
                   [this](io::http::server_request asked, io::http::responder to) {
                     answer(answering_.take(request_of(std::move(asked))), std::move(to));
                   },
               .max_body_bytes = max_body_bytes,
               .tls =
                   [this, &faults] {
                     const bool is_wrong = faults.next_is_wrong_host() && tls_.wrong_host;
                     return is_wrong ? tls_.wrong_host : tls_.usual;
                   }}) {}

tl::expected<void, std::string> service_server::listen() {
  return server_.listen().map_error([](const io::http::error& failed) { return failed.message(); });
}

void service_server::answer(const taken_call& call, io::http::responder to) {
  auto given = answering_.answer_to(call, now_ns(), patience::some);
  if (const auto* poll = std::get_if<waiting>(&given))
    return hold(call, std::move(to), poll->wait_s);
  give(call, std::move(to), std::get<delivery>(std::move(given)));
  if (call.where == endpoint::delete_mission)
    wake_polls();
}

void service_server::give(const taken_call& call, io::http::responder to, delivery what) {
  if (teller_)
    teller_(line_of(call, what));
  compress(what, call.asked.accept_encoding);
  deliver(io_, std::move(to), std::move(what));
}

void service_server::hold(const taken_call& call, io::http::responder to, std::uint64_t wait_s) {
  const auto number = ++last_poll_;
  to.on_gone([this, number] { polls_.erase(number); });
  auto made = held_poll{std::move(to), call, boost::asio::steady_timer(io_)};
  auto& poll = polls_.emplace(number, std::move(made)).first->second;
  poll.timer.expires_after(std::chrono::seconds(wait_s));
  poll.timer.async_wait([this, number](const boost::system::error_code& cancelled) {
    if (!cancelled)
      end_poll(number, patience::none);
  });
}

void service_server::end_poll(std::uint64_t number, patience how_long) {
  const auto found = polls_.find(number);
  if (found == polls_.end())
    return;
  auto given = answering_.answer_to(found->second.call, now_ns(), how_long);
  if (!std::holds_alternative<delivery>(given))
    return;
  auto over = std::move(found->second);
  polls_.erase(found);
  give(over.call, std::move(over.to), std::get<delivery>(std::move(given)));
}

void service_server::wake_polls() {
  std::vector<std::uint64_t> waiting; // those that are answered leave the map
  for (const auto& [number, poll] : polls_)
    waiting.push_back(number);
  for (const auto number : waiting)
    end_poll(number, patience::some);
}

connection_figures service_server::figures() const {
  const auto counted = server_.counters();
  return {
      .accepted = counted.accepted, .turned_away = counted.turned_away, .open = counted.open, .polls = polls_.size()};
}

} // namespace godwit::sim::missions
