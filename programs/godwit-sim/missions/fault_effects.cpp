#include "programs/godwit-sim/missions/fault_effects.hpp"

#include <string>
#include <string_view>

#include "programs/godwit-sim/missions/problem_answer.hpp"

namespace godwit::sim::missions {
namespace {

constexpr unsigned ok = 200;

// Behind the first { of the body. An error may have any form, so only successes are touched.
void put_property(delivery& to, std::string_view property) {
  auto& body = to.what.body;
  if (to.what.status != ok || body.empty() || body.front() != '{')
    return;
  body.insert(1, std::string(property) + (body.starts_with("{}") ? "" : ","));
}

struct effect {
  delivery& to;

  void operator()(const fault::refuse&) const {}
  void operator()(const fault::wrong_host&) const {}
  void operator()(const fault::drop&) const { to.is_lost = true; }
  void operator()(const fault::status& what) const {
    to.what = problem_answer(what.code, "A fault that was asked for.");
    if (what.retry_after_s)
      to.what.headers.push_back({"Retry-After", std::to_string(*what.retry_after_s)});
  }
  void operator()(const fault::lose&) const { to.is_lost = true; }
  void operator()(const fault::delay& what) const { to.delay += what.time; }
  void operator()(const fault::slow& what) const { to.bytes_per_s = what.bytes_per_s; }
  void operator()(const fault::reset&) const { to.cut_after = to.what.body.size() / 2; }
  void operator()(const fault::content_type& what) const { to.what.content_type = what.text; }
  void operator()(const fault::truncate&) const { to.what.body.resize(to.what.body.size() / 2); }
  void operator()(const fault::huge&) const { to.padding = huge_body_bytes - to.what.body.size(); }
  void operator()(const fault::schema&) const { put_property(to, R"("what_nobody_knows":true)"); }
  void operator()(const fault::version&) const {
    constexpr std::string_view key = R"("schema_version":")";
    auto& body = to.what.body;
    const auto found = body.find(key);
    if (found == std::string::npos)
      return put_property(to, R"("schema_version":"3.0.0")");
    const auto begin = found + key.size();
    body.replace(begin, body.find('"', begin) - begin, "3.0.0");
  }
};

} // namespace

bool keeps_from_service(const fault::any& what) {
  if (const auto* status = std::get_if<fault::status>(&what))
    return !status->is_committed;
  return std::holds_alternative<fault::drop>(what);
}

void apply(const fault::any& what, delivery& to) { std::visit(effect{to}, what); }

} // namespace godwit::sim::missions
