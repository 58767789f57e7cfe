// Whether a request means this port: by the name under which it asks (Host), and the page that it comes from (Origin).
//
// A page of another site can have a browser ask us under a name of its own that leads here (DNS rebinding), and open
// WebSockets whatever their origin. So only names that we know to be ours are answered, and a request that names its
// origin has to come from a page of the same host and port. Who is no browser says no Origin. Thread: pure.
// Source: RFC 9110, 7.2 (Host); RFC 6454 (Origin); RFC 6455, 10.2.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace godwit::operator_port {

// "drone.local:8088" -> "drone.local", "[::1]:8088" -> "[::1]"; empty: it is no host.
[[nodiscard]] std::string_view host_name(std::string_view host);
// "[::1]" -> "::1"
[[nodiscard]] std::string_view without_brackets(std::string_view name);

// The names of this computer itself, the address TO that was asked, and OTHERS; the port is not compared, since it may
// be forwarded. An address stands for no name, so nobody can make one lead here.
[[nodiscard]] bool is_ours(std::string_view host, std::string_view to, const std::vector<std::string>& others);

// ORIGIN is empty, or that of a page from HOST. IS_SECURE: it came by TLS.
[[nodiscard]] bool is_same_origin(std::string_view origin, std::string_view host, bool is_secure);

} // namespace godwit::operator_port
