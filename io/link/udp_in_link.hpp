// udpin://HOST:PORT: listens, and answers whoever was heard lately.
//
// The port is not shared (no SO_REUSEADDR): a second program would take our datagrams without a word.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include <boost/asio/ip/udp.hpp>

#include "io/link/counter_set.hpp"
#include "io/link/datagram_reader.hpp"
#include "io/link/io_thread.hpp"
#include "io/link/lifecycle.hpp"
#include "io/link/link.hpp"
#include "io/link/liveness.hpp"
#include "io/link/name_lookup.hpp"

namespace godwit::io::link {

// Who was heard lately on a listening UDP socket, and under which number.
//
// Bounded: a new peer takes the place of the one that was silent for longest, if that was heard nothing of for a while;
// else the newcomer gets a number of its own and is not remembered: it is heard, and nothing is sent to it. So a flood
// from many addresses pushes out nobody who speaks. A peer that was silent for `forget_after`
// is forgotten, and is a new one when it comes back. Thread: one at a time. Pure: the clock is the caller's.
class peer_table {
public:
  using time_point = std::chrono::steady_clock::time_point;
  using endpoint = boost::asio::ip::udp::endpoint;

  static constexpr std::chrono::milliseconds keeps_place{2'000}; // since it was heard

  struct peer {
    peer_id id;
    endpoint address;
    time_point heard_at;
  };

  peer_table(std::size_t max_peers, std::chrono::milliseconds forget_after);

  // Something came from ADDRESS; gives its number.
  peer_id heard(const endpoint& address, time_point now);
  void forget_silent(time_point now);

  [[nodiscard]] const std::vector<peer>& all() const { return peers_; }
  [[nodiscard]] std::uint64_t forgotten() const { return forgotten_; }
  [[nodiscard]] std::uint64_t evicted() const { return evicted_; }
  [[nodiscard]] std::uint64_t refused() const { return refused_; } // frames of those that are not remembered

private:
  [[nodiscard]] peer_id free_id();
  [[nodiscard]] bool makes_room(time_point now);

  std::size_t max_peers_;
  std::chrono::milliseconds forget_after_;
  std::vector<peer> peers_;
  peer_id last_id_ = every_peer;
  std::uint64_t forgotten_ = 0;
  std::uint64_t evicted_ = 0;
  std::uint64_t refused_ = 0;
};

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
