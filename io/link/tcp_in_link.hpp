// tcpin://HOST:PORT: listens, and speaks with everybody who connects, as a simulator does.
//
// Each connection is a peer with a queue of its own: one that does not read loses what does not fit, and holds up
// nobody. When there are max_peers a further one is turned away at once, which it sees as a closed connection; those
// that are connected are never given up for a new one. The port may be taken again right after a restart
// (SO_REUSEADDR); two listeners at once are refused by the system. Source: tcp(7), socket(7).
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include <boost/asio/ip/tcp.hpp>

#include "io/link/counter_set.hpp"
#include "io/link/io_thread.hpp"
#include "io/link/lifecycle.hpp"
#include "io/link/link.hpp"
#include "io/link/liveness.hpp"
#include "io/link/name_lookup.hpp"
#include "io/link/open_stream.hpp"

namespace godwit::io::link {

class tcp_in_link final : public link {
public:
  tcp_in_link(const uri& where, link_callbacks callbacks, const link_options& options);
  ~tcp_in_link() override { thread_.stop(); }

  bool send(std::span<const std::byte> bytes, peer_id to) override;
  [[nodiscard]] link_counters counters() const override;
  [[nodiscard]] std::string description() const override;

private:
  using tcp = boost::asio::ip::tcp;
  struct peer {
    peer_id id;
    std::shared_ptr<open_stream> stream;
  };
  static constexpr int max_accepts_a_turn = 16; // then timers and peers have their turn

  void open();
  [[nodiscard]] boost::system::error_code listen(const tcp::endpoint& local);
  void opened();
  void wait_for_peers();
  void accept();
  void accept_failed(int error);
  void connected(tcp::socket socket);
  void left(peer_id who);
  [[nodiscard]] open_stream::hooks hooks(peer_id of);

  uri where_;
  link_callbacks callbacks_;
  std::size_t max_peers_;
  std::size_t queue_bytes_;
  counter_set counters_;
  link_thread thread_;

  mutable std::mutex mutex_; // never held while a callback runs
  std::vector<peer> peers_;
  std::uint64_t peers_refused_ = 0;
  std::string description_;
  bool is_up_ = false;

  peer_id last_id_ = every_peer;
  name_lookup lookup_;
  tcp::acceptor acceptor_;
  lifecycle life_;
  liveness alive_;
};

} // namespace godwit::io::link
