#include "io/link/datagram_reader.hpp"

#include <boost/asio/buffer.hpp>

namespace godwit::io::link {

datagram_reader::datagram_reader(boost::asio::ip::udp::socket& socket, std::span<std::byte> buffer,
                                 std::function<void(const endpoint&, std::span<const std::byte>)> heard,
                                 std::function<bool(int)> failed)
    : socket_(socket), heard_(std::move(heard)), failed_(std::move(failed)), buffer_(buffer) {}

void datagram_reader::start() {
  ++generation_;
  boost::system::error_code ignored;
  socket_.set_option(boost::asio::socket_base::receive_buffer_size(receive_buffer_bytes), ignored);
  wait();
}

void datagram_reader::wait() {
  // An error that is pending on the socket ends the wait, too, and shows itself when we read.
  socket_.async_wait(boost::asio::ip::udp::socket::wait_read,
                     alive_.guard([this, generation = generation_](const boost::system::error_code& cancelled) {
                       if (!cancelled && generation == generation_)
                         read(generation);
                     }));
}

void datagram_reader::read(std::uint64_t generation) {
  for (int n = 0; n < max_a_turn; ++n) {
    endpoint from;
    boost::system::error_code error;
    const auto size_bytes = socket_.receive_from(boost::asio::buffer(buffer_.data(), buffer_.size()), from, 0, error);
    if (error == boost::asio::error::would_block)
      break;
    if (!error)
      heard_(from, buffer_.first(size_bytes));
    else if (!failed_(error.value()))
      return;
    if (generation != generation_)
      return;
  }
  wait();
}

} // namespace godwit::io::link
