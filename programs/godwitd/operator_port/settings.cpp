#include "programs/godwitd/operator_port/settings.hpp"

#include <charconv>
#include <sstream>

#include <boost/asio/ip/address.hpp>

#include "programs/godwitd/operator_port/host_check.hpp"

namespace godwit::operator_port {
namespace {

constexpr std::size_t max_hosts = 16;

tl::unexpected<std::string> mistake(std::string_view text) {
  return tl::make_unexpected("\"" + std::string(text) +
                             "\" is no address with a port; write one such as 127.0.0.1:8088 or [::1]:8088");
}

bool is_loopback(const std::string& host) {
  boost::system::error_code failed;
  const auto address = boost::asio::ip::make_address(host, failed);
  return host == "localhost" || (!failed && address.is_loopback());
}

} // namespace

tl::expected<settings, std::string> read_listen(std::string_view text) {
  auto name = host_name(text);
  if (name.empty() || name.size() == text.size())
    return mistake(text);
  const auto digits = text.substr(name.size() + 1);
  settings result;
  const auto [end, failed] = std::from_chars(digits.data(), digits.data() + digits.size(), result.port);
  if (failed != std::errc() || end != digits.data() + digits.size())
    return mistake(text);
  if (name.front() == '[')
    name = name.substr(1, name.size() - 2);
  result.host = name;
  if (!is_loopback(result.host))
    return tl::make_unexpected(result.host +
                               " is reached from other computers, and the port has neither TLS nor accounts yet: "
                               "name 127.0.0.1 or [::1], and bring it elsewhere by ssh -L");
  return result;
}

tl::expected<std::vector<std::string>, std::string> read_hosts(const std::string& text) {
  std::vector<std::string> result;
  std::istringstream names(text);
  for (std::string each; names >> each;) {
    if (host_name(each) != each)
      return tl::make_unexpected("\"" + each + "\" is no name of a computer; write it without a port");
    result.push_back(each);
  }
  if (result.size() > max_hosts)
    return tl::make_unexpected("there are more than " + std::to_string(max_hosts) + " names");
  return result;
}

} // namespace godwit::operator_port
