#include "io/link/io_thread.hpp"

#include <cstdio>
#include <cstdlib>
#include <future>

#include <boost/asio/post.hpp>

namespace godwit::io::link {

io_thread::io_thread() : context_(1), work_(boost::asio::make_work_guard(context_)) {}

void io_thread::start() {
  thread_ = std::thread([this]() noexcept { context_.run(); });
}

void io_thread::stop() {
  context_.stop();
  check_outside();
  if (thread_.joinable())
    thread_.join();
}

void io_thread::run_inside(const std::function<void()>& what) {
  check_outside();
  std::promise<void> done;
  boost::asio::post(context_, [&] {
    what();
    done.set_value();
  });
  done.get_future().wait();
}

void io_thread::check_outside() const {
  if (thread_.get_id() != std::this_thread::get_id())
    return;
  std::fputs("broken invariant: a link was destroyed inside one of its own callbacks\n", stderr);
  std::abort();
}

std::shared_ptr<io_thread> start_io_thread() {
  auto made = std::make_shared<io_thread>();
  made->start();
  return made;
}

} // namespace godwit::io::link
