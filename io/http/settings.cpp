#include "io/http/settings.hpp"

namespace godwit::io::http {
namespace {

tl::unexpected<error> refused(const std::string& which, std::string what) {
  return failure(errc::invalid_settings, std::move(what), which);
}

result<void> check_bounds(const settings& wanted) {
  constexpr std::chrono::milliseconds none{0};
  if (wanted.connect_timeout <= none || wanted.read_timeout <= none || wanted.total_timeout <= none)
    return refused("time-outs of the HTTP client", "they must be longer than nothing");
  if (wanted.max_under_way == 0)
    return refused("max_under_way", "at least one connection is needed");
  return {};
}

// Whoever listens on the way would own the token. On this computer nobody listens who could not read the file too.
result<void> check_token(const destination& to) {
  if (!to.has_token || to.base.is_tls)
    return {};
  if (to.has_proxy)
    return failure(errc::token_in_clear, "with a token and a proxy the URL must begin with https://", to.base.origin());
  if (!names_this_computer(to.base.host))
    return failure(errc::token_in_clear,
                   "the token would cross the network in clear: use https://, or leave out the token file",
                   to.base.origin());
  return {};
}

result<void> read_proxy(const settings& wanted, destination& to) {
  to.has_proxy = !wanted.proxy.empty();
  if (!to.has_proxy)
    return {};
  auto proxy = parse_url(wanted.proxy);
  if (!proxy)
    return refused("proxy", proxy.error().what);
  if (proxy->is_tls || !proxy->path.empty())
    return refused("proxy", "a proxy is named http://HOST:PORT, without a path; TLS runs through it, not to it");
  to.proxy = std::move(*proxy);
  return {};
}

} // namespace

result<destination> checked(const settings& wanted) {
  destination to;
  auto base = parse_url(wanted.base_url);
  if (!base)
    return refused("base URL", base.error().what);
  to.base = std::move(*base);
  to.has_token = !wanted.token_file.empty();
  const bool has_certificate = !wanted.certificate_file.empty();
  if (has_certificate != !wanted.key_file.empty())
    return refused("client certificate", "a certificate needs its key and a key its certificate: name both files");
  if (!to.base.is_tls && (has_certificate || !wanted.ca_file.empty()))
    return refused("base URL", "a CA file or a client certificate is of no use over http://: write https://");
  return read_proxy(wanted, to)
      .and_then([&] { return check_bounds(wanted); })
      .and_then([&] { return check_token(to); })
      .map([&] { return to; });
}

} // namespace godwit::io::http
