#include "programs/godwitd/operator_port/host_check.hpp"

#include <algorithm>
#include <array>

#include "io/http/message.hpp"

namespace godwit::operator_port {
namespace {

constexpr std::array<std::string_view, 3> own_names{"localhost", "127.0.0.1", "[::1]"};
constexpr std::size_t longest_host = 253 + 6; // a name of the DNS, and a port

bool is_port(std::string_view text) {
  return !text.empty() && text.size() <= 5 && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

} // namespace

std::string_view without_brackets(std::string_view name) {
  return name.starts_with('[') && name.ends_with(']') ? name.substr(1, name.size() - 2) : name;
}

std::string_view host_name(std::string_view host) {
  if (host.empty() || host.size() > longest_host)
    return {};
  const auto end = host.front() == '[' ? host.find(']') + 1 : std::min(host.find(':'), host.size());
  if (end == 0) // a bracket without its partner
    return {};
  const auto rest = host.substr(end);
  if (!rest.empty() && (rest.front() != ':' || !is_port(rest.substr(1))))
    return {};
  return host.substr(0, end);
}

bool is_ours(std::string_view host, std::string_view to, const std::vector<std::string>& others) {
  const auto name = host_name(host);
  const auto is_name = [&](std::string_view each) { return io::http::equals_ignoring_case(each, name); };
  return !name.empty() && (without_brackets(name) == to || std::ranges::any_of(own_names, is_name) ||
                           std::ranges::any_of(others, is_name));
}

bool is_same_origin(std::string_view origin, std::string_view host, bool is_secure) {
  if (origin.empty())
    return true;
  const std::string_view scheme = is_secure ? "https://" : "http://";
  return origin.starts_with(scheme) && io::http::equals_ignoring_case(origin.substr(scheme.size()), host);
}

} // namespace godwit::operator_port
