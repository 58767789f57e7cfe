// udpin://HOST:PORT: listens, and answers whoever was heard lately.
//
// The port is not shared (no SO_REUSEADDR): a second program would take our datagrams without a word.
#pragma once

#include <mutex>

#include <boost/asio/ip/udp.hpp>

#include "io/link/counter_set.hpp"
#include "io/link/datagram_reader.hpp"
#include "io/link/lifecycle.hpp"
#include "io/link/link.hpp"
#include "io/link/link_thread.hpp"
#include "io/link/liveness.hpp"
#include "io/link/name_lookup.hpp"
#include "io/link/peer_table.hpp"

namespace godwit::io::link {

class udp_in_link final : public link {
public:
  udp_in_link(const uri& where, link_callbacks callbacks, const link_options& options);
  ~udp_in_link() override { thread_.stop(); }

  bool send(std::span<const std::byte> bytes, peer_id to) override;
  [[nodiscard]] link_counters counters() const override;
  [[nodiscard]] std::string description() const override;

private:
  using udp = boost::asio::ip::udp;

  void open();
  [[nodiscard]] boost::system::error_code bind(const udp::endpoint& local);
  void opened();
  void heard(const udp::endpoint& from, std::span<const std::byte> bytes);
  [[nodiscard]] bool read_failed(int error);
  [[nodiscard]] bool transmit(std::span<const std::byte> bytes, const udp::endpoint& to);

  uri where_;
  std::function<void(peer_id, std::span<const std::byte>, bool)> received_;
  counter_set counters_;

  mutable std::mutex mutex_; // never held while a callback runs
  int send_descriptor_ = -1; // the socket's, while it is up
  mutable peer_table peers_; // who looks at it, sees who was heard lately
  std::string description_;

  link_thread thread_;
  name_lookup lookup_;
  udp::socket socket_;
  datagram_reader reader_;
  lifecycle life_;
  liveness alive_;
};

} // namespace godwit::io::link
