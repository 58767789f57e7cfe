// Who has a place at the port, in all and from one address (io::http::share_of); a WebSocket has one for as long as it
// lasts.
//
//   there is room ─────────────────────────────────────────────────────────> a place
//   the address has all of its share ── its longest without a session gives way ──> a place; all have one: none
//   there is no room ── of the address with the most without a session, the longest ──> the same
//
// So whoever holds connections open keeps nobody out who logs in, and never displaces who has. One place in eight is
// kept for this computer, whose clients give way to each other alone.
//
//   hooks.admit = [table](const auto& from) { return table->admit(from); };
//
// Thread: admit and end_session in that of the port; a place is proved and given back by any.
#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <string>

#include <boost/asio/ip/address.hpp>

#include "io/http/connection.hpp"
#include "io/http/server/client_share.hpp"

namespace godwit::operator_port {

class client_table : public std::enable_shared_from_this<client_table> {
public:
  static constexpr std::size_t kept_part = 8; // one place in eight is kept for this computer

  client_table(std::size_t max_clients, std::size_t max_an_address)
      : max_clients_(max_clients), max_an_address_(max_an_address) {}

  // Null: there is no room, and nobody gives way.
  [[nodiscard]] std::shared_ptr<io::http::client_place> admit(const boost::asio::ip::address& from);
  // Ends the WebSockets that have come with SESSION. Its other connections, one of which may wait for the answer to a
  // log-out, give way as those without a session.
  void end_session(const std::string& session);

  [[nodiscard]] std::size_t now() const;
  [[nodiscard]] std::uint64_t gave_way() const;

private:
  class place;

  [[nodiscard]] std::size_t count_of(const boost::asio::ip::address& share) const;
  [[nodiscard]] place* longest_without_session(const boost::asio::ip::address& share) const;
  [[nodiscard]] place* who_gives_way(const boost::asio::ip::address& share) const;

  const std::size_t max_clients_;
  const std::size_t max_an_address_;
  mutable std::mutex mutex_; // over the next two
  std::list<place*> places_; // the longest first; at most max_clients
  std::uint64_t gave_way_ = 0;
};

} // namespace godwit::operator_port
