#include "programs/godwitd/operator_port/own_addresses.hpp"

#include <array>
#include <memory>

#include <ifaddrs.h>
#include <netdb.h>
#include <netinet/in.h>

namespace godwit::operator_port {
namespace {

constexpr std::size_t max_addresses = 32;

// Empty: it is none that others could ask for.
std::string text_of(const sockaddr* address) {
  if (address == nullptr || (address->sa_family != AF_INET && address->sa_family != AF_INET6))
    return {};
  const bool is_six = address->sa_family == AF_INET6;
  if (is_six && IN6_IS_ADDR_LINKLOCAL(&reinterpret_cast<const sockaddr_in6*>(address)->sin6_addr))
    return {};
  std::array<char, NI_MAXHOST> text{};
  const auto size = static_cast<socklen_t>(is_six ? sizeof(sockaddr_in6) : sizeof(sockaddr_in));
  if (::getnameinfo(address, size, text.data(), text.size(), nullptr, 0, NI_NUMERICHOST) != 0)
    return {};
  return text.data();
}

} // namespace

std::vector<std::string> own_addresses() {
  std::vector<std::string> result;
  ifaddrs* all = nullptr;
  if (::getifaddrs(&all) != 0)
    return result;
  const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> kept(all, ::freeifaddrs);
  for (const auto* each = all; each != nullptr && result.size() < max_addresses; each = each->ifa_next)
    if (auto text = text_of(each->ifa_addr); !text.empty())
      result.push_back(std::move(text));
  return result;
}

} // namespace godwit::operator_port
