#include "programs/godwitd/operator_port/camera_api.hpp"

#include <string>
#include <string_view>
#include <utility>

#include "io/http/server/response_head.hpp"
#include "io/text.hpp"
#include "io/time_units.hpp"

namespace godwit::operator_port {
namespace {

constexpr std::string_view picture_path = "/api/v1/camera/picture";
constexpr std::string_view point_picture_path = "/api/v1/points/{}/picture";

// Of "?after=N"; nothing: the query is another one.
std::optional<std::uint64_t> read_after(std::string_view target) {
  const auto question = target.find('?');
  if (question == std::string_view::npos)
    return 0;
  constexpr std::string_view name = "after=";
  const auto query = target.substr(question + 1);
  if (!query.starts_with(name))
    return std::nullopt;
  std::uint64_t value = 0;
  return io::read_number(query.substr(name.size()), value) ? std::optional(value) : std::nullopt;
}

// N of /api/v1/points/N/picture.
std::optional<std::uint64_t> point_of(std::string_view target) {
  auto path = target.substr(0, target.find('?'));
  path = path.substr(0, path.rfind('/'));
  path = path.substr(path.rfind('/') + 1);
  std::uint64_t number = 0;
  return io::read_number(path, number) ? std::optional(number) : std::nullopt;
}

} // namespace

route_list camera_api::routes() {
  return {{"GET", picture_path, 0,
           [self = shared_from_this()](const server_request& asked, responder answer) {
             answer.send(self->picture_for(asked));
           }},
          {"GET", point_picture_path, 0, [self = shared_from_this()](const server_request& asked, responder answer) {
             answer.send(self->picture_of_point(asked));
           }}};
}

server_response camera_api::picture_for(const server_request& asked) const {
  const auto after = read_after(asked.target);
  if (!after)
    return io::http::problem_response(400, "Ask with ?after=N, the number of the picture that you have, or without.");
  const auto now_ns = parts_.time->monotonic_ns();
  parts_.want(now_ns + wanted_for_ns);
  auto newest = parts_.newest(0);
  if (!newest || newest->captured_ns > now_ns || now_ns - newest->captured_ns > counts_for_ns)
    return io::http::problem_response(503, "The camera shows nothing now; godwitd ctl status says why. When nobody has "
                                           "asked for a while the first picture needs half a second: ask again.");
  if (newest->number <= *after)
    return {.status = 204, .content_type = {}};
  auto result = answer_with(newest->jpeg, now_ns - newest->captured_ns);
  result.headers.emplace_back("Godwit-Picture", std::to_string(newest->number));
  return result;
}

server_response camera_api::picture_of_point(const server_request& asked) const {
  const auto point = point_of(asked.target);
  const auto seen = point ? parts_.of_point(*point) : std::nullopt;
  if (!seen)
    return io::http::problem_response(404, "There is no picture of that point: the camera did not see it, or it is "
                                           "one of long ago.");
  return answer_with(seen->jpeg, parts_.time->wall_ns() - seen->captured_ns);
}

server_response camera_api::answer_with(const std::vector<std::byte>& jpeg, std::int64_t age_ns) const {
  server_response result{.content_type = "image/jpeg"};
  result.body.assign(reinterpret_cast<const char*>(jpeg.data()), jpeg.size()); // bytes as characters
  result.headers = {{"Godwit-Captured-Ms", std::to_string((parts_.time->wall_ns() - age_ns) / ns_per_ms)},
                    {"Godwit-Age-Ms", std::to_string(age_ns / ns_per_ms)}};
  return result;
}

} // namespace godwit::operator_port
