#include "programs/godwit-sim/missions/server.hpp"

#include <chrono>
#include <utility>

#include <boost/asio/ip/address.hpp>

#include "io/link/uri.hpp"
#include "runtime/assert.hpp"

namespace godwit::sim::missions {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;
using tcp = asio::ip::tcp;

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

std::string sentence_of(const tcp::endpoint& where, const error_code& failed) {
  const auto place = io::link::host_and_port(where.address().to_string(), where.port());
  if (failed == asio::error::address_in_use)
    return "another program listens at " + place + ": end it, or name another port (0 for any free one)";
  return "it can not listen at " + place + ": " + failed.message();
}

} // namespace

server::server(asio::io_context& io, faulty_service& answering, fault_book& faults, server_tls tls, teller tell)
    : io_(io), answering_(answering), faults_(faults), tls_(std::move(tls)), teller_(std::move(tell)), acceptor_(io),
      pause_(io) {}

tl::expected<void, std::string> server::listen(const std::string& host, std::uint16_t port) {
  error_code failed;
  tcp::resolver resolver(io_);
  const auto found = resolver.resolve(host, std::to_string(port), tcp::resolver::passive, failed);
  if (failed || found.empty())
    return tl::unexpected(host + " is no name or address of this computer: " + failed.message());
  where_ = found.begin()->endpoint();
  return open();
}

tl::expected<void, std::string> server::listen_again() {
  return acceptor_.is_open() ? tl::expected<void, std::string>() : open();
}

tl::expected<void, std::string> server::open() {
  error_code failed;
  acceptor_.open(where_.protocol(), failed);
  if (!failed)
    acceptor_.set_option(tcp::acceptor::reuse_address(true), failed);
  if (!failed)
    acceptor_.bind(where_, failed);
  if (!failed)
    acceptor_.listen(asio::socket_base::max_listen_connections, failed);
  if (failed) {
    stop_listening();
    return tl::unexpected(sentence_of(where_, failed));
  }
  where_ = acceptor_.local_endpoint();
  accept();
  return {};
}

void server::stop_listening() {
  error_code ignored; // an acceptor that can not be closed is closed
  acceptor_.close(ignored);
  pause_.cancel();
}

void server::end_connections() {
  while (!connections_.empty())
    connections_.begin()->second->end(); // takes itself out
}

void server::accept() {
  acceptor_.async_accept([this](const error_code& failed, tcp::socket accepted) {
    if (failed == asio::error::operation_aborted || !acceptor_.is_open())
      return;
    if (failed)
      return accept_later();
    welcome(std::move(accepted));
    accept();
  });
}

void server::accept_later() {
  pause_.expires_after(accept_pause);
  pause_.async_wait([this](const error_code& cancelled) {
    if (!cancelled && acceptor_.is_open())
      accept();
  });
}

void server::welcome(tcp::socket accepted) {
  if (connections_.size() == max_connections) {
    ++figures_.turned_away;
    return; // and the socket closes
  }
  ++figures_.accepted;
  error_code ignored; // then it is only slower
  accepted.set_option(tcp::no_delay(true), ignored);
  const auto who = std::make_shared<connection>(
      std::move(accepted),
      connection::callbacks{.asked = [this](connection& asking, request what) { asked(asking, std::move(what)); },
                            .ended = [this](connection& gone) { end_of(gone); }});
  connections_.emplace(who.get(), who);
  const bool is_wrong = faults_.next_is_wrong_host() && tls_.wrong_host;
  who->start(is_wrong ? tls_.wrong_host.get() : tls_.usual.get());
}

void server::asked(connection& who, request what) { answer(who, answering_.take(std::move(what)), patience::some); }

void server::answer(connection& who, const taken_call& call, patience how_long) {
  const auto given = answering_.answer_to(call, now_ns(), how_long);
  if (const auto* poll = std::get_if<waiting>(&given))
    return hold(who, call, poll->wait_s);
  const auto& what = std::get<delivery>(given);
  tell(call, what);
  who.deliver(what);
  if (call.where == endpoint::delete_mission)
    wake_polls();
}

void server::hold(connection& who, const taken_call& call, std::uint64_t wait_s) {
  const auto [place, is_new] = polls_.emplace(&who, held_poll{who.shared_from_this(), call, asio::steady_timer(io_)});
  GODWIT_ASSERT(is_new, "a connection has one request at a time");
  auto& timer = place->second.timer;
  timer.expires_after(std::chrono::seconds(wait_s));
  timer.async_wait([this, key = &who, due = timer.expiry()](const error_code& cancelled) {
    const auto found = polls_.find(key);
    if (cancelled || found == polls_.end() || found->second.timer.expiry() != due)
      return; // that poll is over; there may be a new one
    const auto over = std::move(found->second);
    polls_.erase(found);
    answer(*over.who, over.call, patience::none);
  });
  who.hold();
}

void server::wake_polls() {
  for (auto each = polls_.begin(); each != polls_.end();) {
    const auto given = answering_.answer_to(each->second.call, now_ns(), patience::some);
    if (const auto* what = std::get_if<delivery>(&given)) {
      tell(each->second.call, *what);
      const auto who = each->second.who;
      each = polls_.erase(each);
      who->deliver(*what);
    } else {
      ++each;
    }
  }
}

void server::end_of(connection& who) {
  polls_.erase(&who);
  connections_.erase(&who);
}

connection_figures server::figures() const {
  auto now = figures_;
  now.open = connections_.size();
  now.polls = polls_.size();
  return now;
}

void server::tell(const taken_call& call, const delivery& what) const {
  if (!teller_)
    return;
  constexpr std::size_t shown = 200; // characters of a target
  std::string line = call.asked.verb.substr(0, shown) + " " + call.asked.target.substr(0, shown) + " " +
                     (what.is_lost ? std::string("no answer") : std::to_string(what.what.status));
  if (!call.hits.empty())
    line += ", hit by a fault";
  teller_(line);
}

} // namespace godwit::sim::missions
