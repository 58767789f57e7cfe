// How many clients are there, in all and from one address (io::http::share_of); a WebSocket is one for as long as it
// lasts. The last places are kept for this computer: whoever fills the others keeps nobody there from the vehicle.
//
//   hooks.admit = [table](const auto& from) { return table->admit(from); };
//
// Thread: admit() in that of the port; a place may be given back by any.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>

#include <boost/asio/ip/address.hpp>

#include "io/http/server/client_share.hpp"

namespace godwit::operator_port {

class client_table : public std::enable_shared_from_this<client_table> {
public:
  static constexpr std::size_t kept_part = 8; // one place in eight is kept for this computer

  client_table(std::size_t max_clients, std::size_t max_an_address)
      : max_clients_(max_clients), max_an_address_(max_an_address) {}

  // Null: there is no room.
  [[nodiscard]] std::shared_ptr<void> admit(const boost::asio::ip::address& from) {
    const auto share = io::http::share_of(from);
    const auto most = share.is_loopback() ? max_clients_ : max_clients_ - max_clients_ / kept_part;
    const std::lock_guard guard(mutex_);
    const auto its = clients_.find(share);
    if (now_ >= most || (its != clients_.end() && its->second >= max_an_address_))
      return nullptr;
    ++clients_[share];
    ++now_;
    return std::make_shared<place>(shared_from_this(), share);
  }

  [[nodiscard]] std::size_t now() const {
    const std::lock_guard guard(mutex_);
    return now_;
  }

private:
  struct place {
    place(std::shared_ptr<client_table> table, boost::asio::ip::address address)
        : of(std::move(table)), from(std::move(address)) {}
    place(const place&) = delete;
    place& operator=(const place&) = delete;
    ~place() { of->leave(from); }
    std::shared_ptr<client_table> of;
    boost::asio::ip::address from;
  };

  void leave(const boost::asio::ip::address& from) {
    const std::lock_guard guard(mutex_);
    --now_;
    const auto found = clients_.find(from);
    if (--found->second == 0)
      clients_.erase(found);
  }

  const std::size_t max_clients_;
  const std::size_t max_an_address_;
  mutable std::mutex mutex_;                                // over the next two
  std::map<boost::asio::ip::address, std::size_t> clients_; // those that have any: at most max_clients
  std::size_t now_ = 0;
};

} // namespace godwit::operator_port
