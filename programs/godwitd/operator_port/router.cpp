#include "programs/godwitd/operator_port/router.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "io/http/server/response_head.hpp"
#include "io/http/url.hpp"
#include "programs/godwitd/operator_port/host_check.hpp"

namespace godwit::operator_port {

namespace {

using io::http::problem_response;

// The first segment of REST, which goes on after it.
std::string_view take_segment(std::string_view& rest) {
  const auto end = std::min(rest.find('/'), rest.size());
  const auto result = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return result;
}

bool matches(std::string_view pattern, std::string_view path) {
  if (pattern.ends_with("/*"))
    return path.starts_with(pattern.substr(0, pattern.size() - 1));
  if (std::ranges::count(pattern, '/') != std::ranges::count(path, '/'))
    return false;
  while (!pattern.empty() || !path.empty()) {
    const auto wanted = take_segment(pattern);
    const auto given = take_segment(path);
    if (wanted == "{}" ? given.empty() : wanted != given)
      return false;
  }
  return true;
}

std::string_view method_of(std::string_view asked) { return asked == "HEAD" ? std::string_view("GET") : asked; }

} // namespace

std::string_view path_of(std::string_view target) { return target.substr(0, target.find('?')); }

const route* router::find(std::string_view method, std::string_view target) const {
  const auto found = std::ranges::find_if(routes_, [&](const route& each) {
    return each.method == method_of(method) && matches(each.path, path_of(target));
  });
  return found == routes_.end() ? nullptr : &*found;
}

std::string router::methods_at(std::string_view target) const {
  std::string result;
  for (const auto& each : routes_)
    if (matches(each.path, path_of(target)))
      result.append(result.empty() ? "" : ", ").append(each.method).append(each.method == "GET" ? ", HEAD" : "");
  return result;
}

std::size_t router::max_body_bytes(std::string_view method, std::string_view target) const {
  const auto* const found = find(method, target);
  return found == nullptr ? 0 : found->max_body_bytes;
}

server_response router::refusal_of(const server_request& asked) {
  const auto methods = methods_at(asked.target);
  if (methods.empty()) {
    ++counts_.no_such_path;
    return problem_response(404, "There is nothing here; docs/operator_port.md has what there is.");
  }
  ++counts_.no_such_method;
  auto result = problem_response(405, "Here one may ask: " + methods + ".");
  result.headers.push_back({"Allow", methods});
  return result;
}

void router::let_in(const route& to, server_request asked, responder answer) {
  if (to.who == access::open || io::http::names_this_computer(asked.from))
    return to.handle(std::move(asked), std::move(answer));
  if (!gate_) {
    ++counts_.not_let_in;
    return answer.send(problem_response(401, "Nothing is shown to another computer here."));
  }
  auto shared = std::make_shared<server_request>(std::move(asked));
  gate_(*shared, std::move(answer), [&to, shared](responder then) { to.handle(std::move(*shared), std::move(then)); });
}

void router::answer(server_request asked, responder answer) {
  const auto host = asked.find("Host");
  if (!is_ours(host, asked.to, hosts_)) {
    ++counts_.other_host;
    return answer.send(problem_response(421, "This computer is not known under that name: ask for localhost, or have "
                                             "the name entered in operator.hosts of the configuration."));
  }
  if (!is_same_origin(asked.find("Origin"), host, is_secure_)) {
    ++counts_.other_origin;
    if (other_origin_)
      other_origin_(asked.from);
    return answer.send(problem_response(403, "Pages of other sites may ask for nothing here."));
  }
  if (const auto* const found = find(asked.method, asked.target))
    return let_in(*found, std::move(asked), std::move(answer));
  answer.send(refusal_of(asked));
}

} // namespace godwit::operator_port
