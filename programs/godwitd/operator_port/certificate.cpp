#include "programs/godwitd/operator_port/certificate.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include <ifaddrs.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/stat.h>

#include "io/http/server/identity.hpp"
#include "io/http/tls.hpp"
#include "programs/godwitd/operator_port/host_check.hpp"

namespace godwit::operator_port {

namespace {

// The names that a certificate of ours must have, so that a browser takes it for each under which we are asked.
std::vector<std::string> names_of(const settings& wanted) {
  std::vector<std::string> result{"localhost", "127.0.0.1", "::1"};
  for (const auto& each : wanted.hosts)
    result.emplace_back(without_brackets(each));
  if (!wanted.is_local && wanted.host != "0.0.0.0" && wanted.host != "::")
    result.push_back(wanted.host);
  return result;
}

} // namespace

tl::expected<certificate, std::string> certificate::load(const settings& wanted) {
  certificate result(wanted);
  if (auto read = result.read(); !read)
    return tl::make_unexpected(std::move(read.error()));
  return result;
}

std::vector<certificate::file_stamp> certificate::stamps() const {
  std::vector<file_stamp> result;
  for (const auto* each : {&wanted_.certificate_file, &wanted_.key_file, &wanted_.identity_file}) {
    struct stat found {};
    if (!each->empty() && ::stat(each->c_str(), &found) == 0)
      result.push_back({found.st_ino, found.st_mtim.tv_sec * 1'000'000'000LL + found.st_mtim.tv_nsec, found.st_size});
    else
      result.emplace_back();
  }
  return result;
}

// Its own that is gone is made anew at a start alone: whoever has compared its fingerprint has done so once.
tl::expected<bool, std::string> certificate::read_anew(bool even_if_same) {
  const auto now = stamps();
  if (!even_if_same && now == read_as_)
    return false;
  read_as_ = now;
  if (wanted_.certificate_file.empty() && now.back() == file_stamp{})
    return tl::make_unexpected(wanted_.identity_file +
                               " is gone: the certificate stays as it was until the next start");
  const auto before = fingerprint_;
  if (auto read = this->read(); !read)
    return tl::make_unexpected(read.error() + "; the certificate stays as it was");
  return fingerprint_ != before;
}

tl::expected<void, std::string> certificate::read() {
  read_as_ = stamps(); // before, so that what changes meanwhile is read again
  io::http::server_identity who;
  bool is_new = false;
  if (!wanted_.certificate_file.empty()) {
    auto loaded = io::http::load_identity(wanted_.certificate_file, wanted_.key_file);
    if (!loaded)
      return tl::make_unexpected(loaded.error().message());
    who = *std::move(loaded);
  } else {
    auto kept = io::http::keep_identity(wanted_.identity_file, names_of(wanted_), own_addresses());
    if (!kept)
      return tl::make_unexpected(kept.error().message());
    who = std::move(kept->identity);
    is_new = kept->is_new;
    if (is_new)
      read_as_ = stamps();
  }
  auto made = io::http::make_server_tls_context(who.certificate, who.key.revealed());
  if (!made)
    return tl::make_unexpected(made.error().message() +
                               (wanted_.certificate_file.empty()
                                    ? std::string()
                                    : " (" + wanted_.certificate_file + ", " + wanted_.key_file + ")"));
  context_ = *std::move(made);
  fingerprint_ = io::http::fingerprint_of(who.certificate);
  is_new_ = is_new;
  return {};
}

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
