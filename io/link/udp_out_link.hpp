// udpout://HOST:PORT: sends to one place from a free port, and hears what comes back from there.
//
// The socket is connected, so the system keeps strangers out and tells when nobody listens. That news does not close
// the socket: the other side is often only not started yet, and what we send is what lets it find us.
#pragma once

#include <mutex>

#include <boost/asio/ip/udp.hpp>
#include <boost/asio/steady_timer.hpp>

#include "io/link/counter_set.hpp"
#include "io/link/datagram_reader.hpp"
#include "io/link/lifecycle.hpp"
#include "io/link/link.hpp"
#include "io/link/link_thread.hpp"
#include "io/link/liveness.hpp"
#include "io/link/name_lookup.hpp"
#include "io/link/refusal_watch.hpp"

namespace godwit::io::link {

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
