// How many clients are there, in all and from one address; a WebSocket is one for as long as it lasts.
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

namespace godwit::operator_port {

class client_table : public std::enable_shared_from_this<client_table> {
public:
  client_table(std::size_t max_clients, std::size_t max_an_address)
      : max_clients_(max_clients), max_an_address_(max_an_address) {}

  // Null: there is no room.
  [[nodiscard]] std::shared_ptr<void> admit(const boost::asio::ip::address& from) {
    const std::lock_guard guard(mutex_);
    auto& its = clients_[from];
    if (now_ >= max_clients_ || its >= max_an_address_) {
      if (its == 0)
        clients_.erase(from);
      return nullptr;
    }
    ++its;
    ++now_;
    return std::make_shared<place>(shared_from_this(), from);
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
