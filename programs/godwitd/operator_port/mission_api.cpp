#include "programs/godwitd/operator_port/mission_api.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <utility>

#include "actors/domain/mission/convert/convert.hpp"
#include "actors/domain/uuid/uuid.hpp"
#include "io/fields/json_text.hpp"
#include "programs/godwitd/accounts/password.hpp"
#include "programs/godwitd/operator_port/api_answers.hpp"
#include "programs/godwitd/operator_port/request_body.hpp"

namespace godwit::operator_port {

namespace {

struct checked_mission {
  mission::document mission;
  std::vector<mission::loss> losses;
  GODWIT_FIELDS(checked_mission, "operator_port.checked_mission", mission, losses);
};

using refused = tl::unexpected<server_response>;

// VALUE of "NAME=VALUE" in the query; empty: it is not there.
std::string_view of_query(std::string_view target, std::string_view name) {
  auto rest = target.substr(std::min(target.find('?'), target.size() - 1) + 1);
  while (!rest.empty()) {
    const auto end = std::min(rest.find('&'), rest.size());
    const auto each = rest.substr(0, end);
    if (each.starts_with(name) && each.substr(name.size()).starts_with('='))
      return each.substr(name.size() + 1);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return {};
}

// Another one for each upload: it is the revision of no other mission.
std::string fresh_id() {
  constexpr std::uint64_t version = 0x4000;
  constexpr std::uint64_t variant = 0x8000'0000'0000'0000;
  std::random_device source;
  const auto bits = [&source] { return (std::uint64_t{source()} << 32U) | source(); };
  return ids::text_of({(bits() & ~std::uint64_t{0xf000}) | version, (bits() & ~(std::uint64_t{3} << 62U)) | variant});
}

tl::expected<checked_mission, server_response> read_mission(const server_request& asked,
                                                            const mission::allowed_commands& allowed) {
  if (!asked.find("Content-Type").starts_with("application/octet-stream"))
    return refused(problem(415, "the body is the file, as application/octet-stream"));
  const auto format = io::value_of<mission::mission_format>(of_query(asked.target, "format"));
  if (!format)
    return refused(problem(400, "a format is missing: json, plan, waypoints, geojson or kml", "format"));
  auto read = mission::import_mission(
      asked.body, *format,
      {.allow_partial = of_query(asked.target, "partial") == "yes", .mission_id = fresh_id(), .allowed = allowed});
  if (read)
    return checked_mission{std::move(read->mission), std::move(read->losses.all)};
  const bool is_lossy = read.error().error.code == mission::document_errc::lossy;
  auto result = problem(422, is_lossy ? "it can not be carried over as a whole:\n" + read.error().losses.message()
                                      : read.error().message());
  return refused(std::move(result));
}

// HANDLE, run by RUN.
auto in_background(const run_in_background& run, std::function<void(const server_request&, responder)> handle) {
  return [run, handle = std::move(handle)](const server_request& asked, responder answer) {
    struct waiting {
      server_request asked;
      responder answer;
    };
    const auto kept = std::make_shared<waiting>(asked, std::move(answer));
    if (!run(asked.from, [kept, handle] { handle(kept->asked, std::move(kept->answer)); }))
      kept->answer.send(problem(503, "other files are being read; send it again in a few seconds"));
  };
}

} // namespace

route_list mission_routes(const std::shared_ptr<waiting_answers>& answers,
                          const std::function<void(mission_upload asked)>& tell, const run_in_background& run,
                          const mission::allowed_commands& allowed) {
  const auto check = [allowed](const server_request& asked, responder answer) {
    const auto read = read_mission(asked, allowed);
    answer.send(read ? server_response{.body = io::to_json(*read)} : read.error());
  };
  const auto upload = [answers, tell, allowed](const server_request& asked, responder answer) {
    auto read = read_mission(asked, allowed);
    if (!read)
      return answer.send(read.error());
    const auto token = token_of(asked);
    if (const auto ticket = answers->add(std::move(answer)))
      tell({*ticket, token.empty() ? std::string() : accounts::hash_of_token(token), std::move(read->mission)});
  };
  return {{"POST", "/api/v1/missions/check", max_mission_file, in_background(run, check)},
          {"POST", "/api/v1/missions", max_mission_file, in_background(run, upload)}};
}

} // namespace godwit::operator_port
