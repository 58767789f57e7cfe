#include "io/link/name_lookup.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>
#include <system_error>
#include <thread>

#include <boost/asio/post.hpp>
#include <netdb.h>

namespace godwit::io::link {
namespace {

namespace ip = boost::asio::ip;

ip::address to_address(const addrinfo& entry) {
  if (entry.ai_family == AF_INET) {
    sockaddr_in v4{};
    std::memcpy(&v4, entry.ai_addr, sizeof v4);
    return ip::address_v4(ntohl(v4.sin_addr.s_addr));
  }
  sockaddr_in6 v6{};
  std::memcpy(&v6, entry.ai_addr, sizeof v6);
  ip::address_v6::bytes_type bytes{};
  std::memcpy(bytes.data(), &v6.sin6_addr, bytes.size());
  return ip::address_v6(bytes, v6.sin6_scope_id);
}

std::string lookup_reason(const std::string& host, int code) {
  switch (code) {
  case EAI_NONAME:
  case EAI_NODATA:
    return host + ": host name not found";
  case EAI_AGAIN:
    return host + ": host name not found: the name server does not answer; is this computer connected?";
  default:
    return host + ": host name not found: " + ::gai_strerror(code);
  }
}

} // namespace

found_addresses ask_system(const std::string& host) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_DGRAM; // one entry for each address instead of one for each kind of socket
  addrinfo* first = nullptr;
  if (const int code = ::getaddrinfo(host.c_str(), nullptr, &hints, &first); code != 0)
    return tl::make_unexpected(lookup_reason(host, code));
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> owner(first, ::freeaddrinfo);
  std::vector<ip::address> addresses;
  for (const addrinfo* each = first; each != nullptr; each = each->ai_next)
    if (each->ai_family == AF_INET || each->ai_family == AF_INET6)
      addresses.push_back(to_address(*each));
  if (addresses.empty())
    return tl::make_unexpected(lookup_reason(host, EAI_NODATA));
  std::stable_partition(addresses.begin(), addresses.end(), [](const ip::address& each) { return each.is_v4(); });
  return addresses;
}

std::shared_ptr<lookup_places> places_of_this_process() {
  static const auto places = std::make_shared<lookup_places>();
  return places;
}

struct name_lookup::request {
  std::mutex mutex;
  boost::asio::io_context* answers_to; // null: nobody waits any more

  void answer(std::function<void()> handler) {
    const std::lock_guard lock(mutex);
    if (answers_to != nullptr)
      boost::asio::post(*answers_to, std::move(handler));
  }
  void give_up() {
    const std::lock_guard lock(mutex);
    answers_to = nullptr;
  }
};

name_lookup::name_lookup(boost::asio::io_context& io, blocking_lookup look_up, std::shared_ptr<lookup_places> places)
    : io_(io), look_up_(std::move(look_up)), places_(std::move(places)) {}

name_lookup::~name_lookup() {
  if (under_way_)
    under_way_->give_up();
}

void name_lookup::start(const std::string& host, const std::function<void(found_addresses)>& done) {
  boost::system::error_code is_a_name;
  const auto address = ip::make_address(host, is_a_name);
  if (!is_a_name)
    return done(std::vector{address});
  if (!places_->take())
    return done(tl::make_unexpected(host + ": too many host names are being looked up; is the name server down?"));
  under_way_ = std::make_shared<request>();
  under_way_->answers_to = &io_;
  try {
    std::thread([host, answered = alive_.guard(done), places = places_, look_up = look_up_, request = under_way_] {
      auto found = look_up(host);
      places->give_back();
      request->answer([answered, found = std::move(found)]() mutable { answered(found); });
    }).detach();
  } catch (const std::system_error& failure) {
    places_->give_back();
    done(tl::make_unexpected(host + ": no thread to look up the host name: " + failure.what()));
  }
}

} // namespace godwit::io::link
