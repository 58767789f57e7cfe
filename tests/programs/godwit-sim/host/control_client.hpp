// A client of the control port, for tests: plain JSON lines over a plain socket. Throws when there is no answer.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "tests/io/link/far_ends.hpp"

namespace godwit::sim {

class control_client {
public:
  explicit control_client(std::uint16_t port) : connection_(port) {}

  void write(std::string_view text) const { connection_.write(text); }
  [[nodiscard]] nlohmann::json ask(const nlohmann::json& request) {
    write(request.dump() + "\n");
    return next_answer();
  }
  [[nodiscard]] nlohmann::json next_answer() {
    auto end = text_.find('\n');
    while (end == std::string::npos) {
      const auto more = connection_.read(1);
      if (more.empty())
        throw std::runtime_error("no answer on the control port");
      text_ += more;
      end = text_.find('\n');
    }
    const auto line = text_.substr(0, end);
    text_.erase(0, end + 1);
    return nlohmann::json::parse(line);
  }
  // One that has come already.
  [[nodiscard]] bool has_answer() const { return connection_.has_bytes(); }

private:
  io::link::testing::tcp_caller connection_;
  std::string text_;
};

} // namespace godwit::sim
