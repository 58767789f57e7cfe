#include "programs/godwitd/operator_port/settings.hpp"

#include <charconv>
#include <sstream>

#include "io/http/url.hpp"
#include "programs/godwitd/operator_port/host_check.hpp"

namespace godwit::operator_port {
namespace {

constexpr std::size_t max_hosts = 16;

tl::unexpected<std::string> mistake(std::string_view text) {
  return tl::make_unexpected("\"" + std::string(text) +
                             "\" is no address with a port; write one such as 127.0.0.1:8088 or [::1]:8088");
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
  result.is_local = io::http::names_this_computer(result.host);
  result.uses_tls = !result.is_local;
  return result;
}

std::optional<std::string> objection_to(const settings& wanted, bool has_accounts) {
  if (wanted.is_local || has_accounts)
    return std::nullopt;
  return wanted.host +
         " is reached from other computers, and nobody has an account: make one with `godwitd operator add "
         "NAME --role operator`, or name 127.0.0.1 and bring the port elsewhere by ssh -L";
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
