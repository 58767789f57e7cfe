// udpout://HOST:PORT: sends to one place from a free port, and hears what comes back from there.
//
// The socket is connected, so the system keeps strangers out and tells when nobody listens. That news does not close
// the socket: the other side is often only not started yet, and what we send is what lets it find us.
#pragma once

#include <chrono>
#include <mutex>
#include <optional>

#include <boost/asio/ip/udp.hpp>
#include <boost/asio/steady_timer.hpp>

#include "io/link/counter_set.hpp"
#include "io/link/datagram_reader.hpp"
#include "io/link/io_thread.hpp"
#include "io/link/lifecycle.hpp"
#include "io/link/link.hpp"
#include "io/link/liveness.hpp"
#include "io/link/name_lookup.hpp"

namespace godwit::io::link {

// Tells when a UDP peer that has refused may be taken to listen again, although it says nothing.
//
// A refusal (ICMP, port unreachable) answers something that was sent. So the peer is back when something was sent after
// the last refusal, and `answer_time` has gone by without a new one. Systems send such news once a second at most, so
// a shorter time would see gaps between them as the peer's return; the rest is for a slow line. With a heartbeat each
// second a peer that came back is believed within 4 s. Thread: one at a time. Pure: the clock is the caller's.
// Source: udp(7), icmp(7).
class refusal_watch {
public:
  using time_point = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::milliseconds answer_time{2'500};

  void refused() { sent_since_refusal_.reset(); }
  void sent(time_point now) {
    if (!sent_since_refusal_)
      sent_since_refusal_ = now;
  }
  [[nodiscard]] bool is_over(time_point now) const {
    return sent_since_refusal_ && now - *sent_since_refusal_ >= answer_time;
  }

private:
  std::optional<time_point> sent_since_refusal_;
};

class udp_out_link final : public link {
public:
  udp_out_link(const uri& where, link_callbacks callbacks, const link_options& options);
  ~udp_out_link() override { thread_.stop(); }

  bool send(std::span<const std::byte> bytes, peer_id to) override;
  [[nodiscard]] link_counters counters() const override { return counters_.values(); }
  [[nodiscard]] std::string description() const override { return where_.text(); }

private:
  using udp = boost::asio::ip::udp;
  static constexpr std::chrono::milliseconds look_again{250}; // whether a refusal is over

  void open();
  void connect(const boost::asio::ip::address& address);
  void heard(std::span<const std::byte> bytes);
  [[nodiscard]] bool read_failed(int error);
  void refused(int error);
  void look_whether_refusal_is_over();
  void lost(int error);
  void report(int error);

  uri where_;
  std::string place_; // HOST:PORT
  std::function<void(peer_id, std::span<const std::byte>, bool)> received_;
  counter_set counters_;

  std::mutex mutex_;         // never held while a callback runs
  int send_descriptor_ = -1; // the socket's, while it is open and sends go through
  refusal_watch watch_;
  bool report_under_way_ = false; // a sender has told the link's thread of an error, which it has not looked at yet

  link_thread thread_;
  name_lookup lookup_;
  udp::socket socket_;
  datagram_reader reader_;
  boost::asio::steady_timer refusal_timer_;
  bool refusal_timer_runs_ = false;
  lifecycle life_;
  liveness alive_;
};

} // namespace godwit::io::link
