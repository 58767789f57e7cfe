#include "io/link/io_thread.hpp"

#include <cstdio>
#include <cstdlib>

namespace godwit::io::link {

io_thread::io_thread() : context_(1), work_(boost::asio::make_work_guard(context_)) {}

void io_thread::start() {
  thread_ = std::thread([this]() noexcept { context_.run(); });
}

void io_thread::stop() {
  context_.stop();
  if (thread_.get_id() == std::this_thread::get_id()) {
    std::fputs("broken invariant: a link was destroyed inside one of its own callbacks\n", stderr);
    std::abort();
  }
  if (thread_.joinable())
    thread_.join();
}

} // namespace godwit::io::link
