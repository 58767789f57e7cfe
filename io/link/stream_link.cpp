#include "io/link/stream_link.hpp"

#include <boost/asio/post.hpp>

namespace godwit::io::link {

stream_link::stream_link(const uri& where, link_callbacks callbacks, const link_options& options,
                         std::chrono::milliseconds retry_cap, const make_opener& opener)
    : where_(where), received_(std::move(callbacks.received)), thread_(options.thread),
      opener_(opener(thread_.context())), life_(thread_.context(), {options.first_retry, retry_cap}, counters_,
                                                std::move(callbacks.changed), [this] { open(); }),
      stream_(thread_.context(), thread_.buffer(), options.send_queue_bytes, counters_, hooks()) {
  boost::asio::post(thread_.context(), alive_.guard([this] { life_.begin("opening " + where_.text()); }));
  thread_.start();
}

open_stream::hooks stream_link::hooks() {
  return {.write = [this](int stream, std::span<const std::byte> bytes) { return opener_->write(stream, bytes); },
          .discard_output = [this](int stream) { opener_->discard_output(stream); },
          .received = [this](std::span<const std::byte> bytes) { received_(only_peer, bytes, false); },
          .ended = [this](int error) { life_.failed(opener_->why_it_ended(error)); }};
}

void stream_link::open() {
  opener_->open([this](stream_opener::result result) {
    if (!result)
      return life_.failed(result.error());
    opened(*std::move(result));
  });
}

void stream_link::opened(descriptor stream) {
  if (const auto error = stream_.take(std::move(stream)))
    return life_.failed(opener_->why_it_ended(error.value()));
  life_.opened("connected to " + opener_->where());
}

bool stream_link::send(std::span<const std::byte> bytes, peer_id to) {
  if (bytes.empty())
    return true;
  if (to > only_peer) {
    counters_.tx_no_peer.add();
    return false;
  }
  return stream_.send(bytes);
}

link_counters stream_link::counters() const {
  auto all = counters_.values();
  all.tx_queued_bytes = stream_.queued_bytes();
  return all;
}

} // namespace godwit::io::link
