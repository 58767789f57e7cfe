// Looks up the addresses of a host without holding up the link's end.
//
// The system's look-up blocks, sometimes for half a minute, and can not be broken off. So it runs in a thread of its
// own that nobody waits for: when the link is gone, its answer is thrown away. There are only so many places for such
// threads in the process; when all are taken a look-up fails, and its link tries again later.
//
// Errors: a sentence. Thread: the link's own; the function that looks up is called in another.
// Source: getaddrinfo(3).
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/address.hpp>
#include <tl/expected.hpp>

#include "io/link/liveness.hpp"

namespace godwit::io::link {

// Not empty; IPv4 first, because that is where MAVLink programs listen.
using found_addresses = tl::expected<std::vector<boost::asio::ip::address>, std::string>;
using blocking_lookup = std::function<found_addresses(const std::string& host)>;

[[nodiscard]] found_addresses ask_system(const std::string& host);

// Thread: any.
class lookup_places {
public:
  static constexpr int max_under_way = 8;

  [[nodiscard]] bool take() {
    const bool is_free = taken_.fetch_add(1) < max_under_way;
    if (!is_free)
      give_back();
    return is_free;
  }
  void give_back() { taken_.fetch_sub(1); }

private:
  std::atomic<int> taken_{0};
};

// Of the process and not of a link, because the threads outlive their links.
[[nodiscard]] std::shared_ptr<lookup_places> places_of_this_process();

class name_lookup {
public:
  explicit name_lookup(boost::asio::io_context& io, blocking_lookup look_up = ask_system,
                       std::shared_ptr<lookup_places> places = places_of_this_process());
  ~name_lookup(); // gives up what is under way

  name_lookup(const name_lookup&) = delete;
  name_lookup& operator=(const name_lookup&) = delete;

  // DONE is called once in the link's thread: before this returns when HOST is an address, else later.
  void start(const std::string& host, const std::function<void(found_addresses)>& done);

private:
  struct request;

  boost::asio::io_context& io_;
  blocking_lookup look_up_;
  std::shared_ptr<lookup_places> places_;
  std::shared_ptr<request> under_way_;
  liveness alive_;
};

} // namespace godwit::io::link
