// A link over one stream of bytes: a serial line or a TCP connection, whichever the opener opens.
#pragma once

#include "io/link/counter_set.hpp"
#include "io/link/lifecycle.hpp"
#include "io/link/link.hpp"
#include "io/link/link_thread.hpp"
#include "io/link/liveness.hpp"
#include "io/link/open_stream.hpp"
#include "io/link/stream_opener.hpp"

namespace godwit::io::link {

class stream_link final : public link {
public:
  using make_opener = std::function<std::unique_ptr<stream_opener>(boost::asio::io_context&)>;

  stream_link(const uri& where, link_callbacks callbacks, const link_options& options,
              std::chrono::milliseconds retry_cap, const make_opener& opener);
  ~stream_link() override { thread_.stop(); }

  bool send(std::span<const std::byte> bytes, peer_id to) override;
  [[nodiscard]] link_counters counters() const override;
  [[nodiscard]] std::string description() const override { return where_.text(); }

private:
  void open();
  void opened(descriptor stream);
  [[nodiscard]] open_stream::hooks hooks();

  uri where_;
  std::function<void(peer_id, std::span<const std::byte>, bool)> received_;
  counter_set counters_;
  link_thread thread_;
  std::unique_ptr<stream_opener> opener_;
  lifecycle life_;
  open_stream stream_;
  liveness alive_;
};

} // namespace godwit::io::link
