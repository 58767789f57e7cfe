// The certificate of the port: given in two files, or the port's own. Read anew when its files have changed or somebody
// asks for it: who is connected goes on with the one of then, new connections have the new one.
//
// Errors: as sentences with what to do; then it stays as it was. Blocks on the disk. Thread: one.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <boost/asio/ssl/context.hpp>
#include <sys/types.h>
#include <tl/expected.hpp>

#include "programs/godwitd/operator_port/settings.hpp"

namespace godwit::operator_port {

class certificate {
public:
  [[nodiscard]] static tl::expected<certificate, std::string> load(const settings& wanted);

  // True: another one counts from now on. Looks at the files alone unless EVEN_IF_SAME.
  [[nodiscard]] tl::expected<bool, std::string> read_anew(bool even_if_same);

  [[nodiscard]] const std::shared_ptr<boost::asio::ssl::context>& context() const { return context_; }
  // SHA-256: "3A:5F:...".
  [[nodiscard]] const std::string& fingerprint() const { return fingerprint_; }
  [[nodiscard]] bool is_new() const { return is_new_; } // our own, made when it was loaded

private:
  struct file_stamp {
    ino_t number = 0;
    std::int64_t changed_ns = 0;
    std::int64_t bytes = 0;
    bool operator==(const file_stamp&) const = default;
  };

  explicit certificate(settings wanted) : wanted_(std::move(wanted)) {}
  [[nodiscard]] std::vector<file_stamp> stamps() const;
  [[nodiscard]] tl::expected<void, std::string> read();

  settings wanted_;
  std::vector<file_stamp> read_as_; // its files, when they were read last
  std::shared_ptr<boost::asio::ssl::context> context_;
  std::string fingerprint_;
  bool is_new_ = false;
};

// The addresses of this computer, as they are now. Those of one line alone (fe80::) are left out, since nobody names
// them without the line. Errors: none are known, and the list is empty. Thread: any. Source: getifaddrs(3).
[[nodiscard]] std::vector<std::string> own_addresses();

} // namespace godwit::operator_port
