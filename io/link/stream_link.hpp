// A link over a stream of bytes: a serial line or a TCP connection, whichever the opener opens.
//
// A send goes to the system in the calling thread as long as nothing waits; what the system does not take goes into the
// queue, and the link's own thread writes it when there is room again.
#pragma once

#include <array>
#include <mutex>

#include <boost/asio/posix/stream_descriptor.hpp>

#include "io/link/counter_set.hpp"
#include "io/link/io_thread.hpp"
#include "io/link/lifecycle.hpp"
#include "io/link/link.hpp"
#include "io/link/send_queue.hpp"
#include "io/link/stream_opener.hpp"

namespace godwit::io::link {

class stream_link final : public link {
public:
  using make_opener = std::function<std::unique_ptr<stream_opener>(boost::asio::io_context&)>;

  stream_link(const uri& where, link_callbacks callbacks, const link_options& options,
              std::chrono::milliseconds retry_cap, const make_opener& opener);
  ~stream_link() override;

  bool send(std::span<const std::byte> bytes, peer_id to) override;
  [[nodiscard]] link_counters counters() const override;
  [[nodiscard]] std::string description() const override { return where_.text(); }

private:
  static constexpr std::size_t read_bytes = 16 * 1024; // several times what a serial line brings in one turn
  static constexpr int max_reads_a_turn = 16;          // then timers and senders have their turn

  // What came of writing until the system takes no more.
  enum class write_end { all_written, system_full, failed };

  void open();
  void opened(descriptor stream);
  void wait_readable();
  void read(std::uint64_t generation);
  void wait_writable();
  void write_queued(std::uint64_t generation);
  [[nodiscard]] write_end write_queue();
  [[nodiscard]] write_end write_some(std::span<const std::byte> bytes, std::size_t& written);
  void fail_soon(int error);
  void lost(int error);

  uri where_;
  std::function<void(peer_id, std::span<const std::byte>, bool)> received_;
  counter_set counters_;

  mutable std::mutex mutex_;    // never held while a callback runs
  int write_descriptor_ = -1;   // the stream's, while it is up
  int write_error_ = 0;         // the last one; why the stream is about to be closed
  bool waits_writable_ = false; // the link's thread writes the queue when there is room
  send_queue queue_;

  io_thread thread_;
  std::unique_ptr<stream_opener> opener_;
  boost::asio::posix::stream_descriptor stream_;
  std::uint64_t generation_ = 0; // of the stream: a wait that was over just before it was closed must not count
  std::array<std::byte, read_bytes> buffer_{};
  lifecycle life_;
};

} // namespace godwit::io::link
