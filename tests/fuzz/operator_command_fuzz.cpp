// Arbitrary bytes as what an operator's program says: the body of a command, of a change of control and of a login over
// HTTP, and a line at the control socket. What is read is within its bounds; what is not leaves a sentence.
//
// The first byte says as what the rest is taken.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "programs/godwitd/control/request_line.hpp"
#include "programs/godwitd/operator_port/request_body.hpp"

namespace {

using namespace godwit;

void require(bool holds) {
  if (!holds)
    std::abort();
}

void require_place(const operators::command& said) {
  if (!said.place)
    return;
  require(std::isfinite(said.place->latitude) && std::isfinite(said.place->longitude) &&
          std::isfinite(said.place->altitude_m));
}

void require_said(const operator_port::body_problem& problem) {
  require(!problem.sentence.empty() && problem.sentence.size() < 1024);
}

void read_command(std::string_view body) {
  const auto read = operator_port::read_command(body);
  if (!read)
    return require_said(read.error());
  require(!read->id.empty());
  require(read->what.kind == operators::command_kind::pause || read->valid_until_ns > 0);
  require_place(read->what);
}

void read_control(std::string_view body) {
  const auto read = operator_port::read_control(body);
  if (!read)
    return require_said(read.error());
  require((read->act == operator_bridge::control_act::hand_over) == !read->to.empty());
}

void read_login(std::string_view body) {
  const auto read = operator_port::read_login(std::string(body));
  if (!read)
    require_said(read.error());
}

void read_line(std::string_view line) {
  const auto read = control::read_request(line);
  if (!read) {
    require(!read.error().empty());
    require(control::refusal_line(read.error()).find('\n') == std::string::npos);
    return;
  }
  require(read->what != control::request_kind::command || !read->by.empty());
  require(read->valid_until_ns >= 0);
  require_place(read->said);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0)
    return 0;
  const std::string_view rest(reinterpret_cast<const char*>(data) + 1, size - 1);
  constexpr int ways = 4;
  switch (data[0] % ways) {
  case 0:
    read_command(rest);
    break;
  case 1:
    read_control(rest);
    break;
  case 2:
    read_login(rest);
    break;
  default:
    read_line(rest);
    break;
  }
  return 0;
}
