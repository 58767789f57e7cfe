#include "io/eyes/codec.hpp"

#include <array>
#include <cmath>
#include <initializer_list>
#include <utility>

#include <nlohmann/json.hpp>

#include "io/fields/json_text.hpp"
#include "io/fields/json_value.hpp"
#include "io/fields/utf8.hpp"

namespace godwit::io::eyes {
namespace {

struct range {
  const char* name;
  double value;
  double least;
  double most;
};

constexpr double far = 1e9; // above whatever a metre, a pixel or a rate can be

std::string out_of(std::initializer_list<range> ranges) {
  for (const auto& each : ranges)
    if (!(each.value >= each.least && each.value <= each.most)) // also when it is not a number
      return std::string(each.name) + " can not be " + std::to_string(each.value);
  return {};
}

std::string too_long(std::initializer_list<const std::string*> texts) {
  for (const auto* each : texts)
    if (each->size() > max_text_bytes)
      return "a text is longer than " + std::to_string(max_text_bytes) + " bytes";
  return {};
}

std::string problem(const begin& m) {
  if (auto text = too_long({&m.uri, &m.record_folder, &m.model}); !text.empty())
    return text;
  return out_of({{"width_px", static_cast<double>(m.width_px), 0, max_side_px},
                 {"height_px", static_cast<double>(m.height_px), 0, max_side_px},
                 {"focal_px", m.focal_px, 0, far},
                 {"k1", m.k1, -1, 1},
                 {"k2", m.k2, -1, 1},
                 {"min_height_m", m.min_height_m, 0, far},
                 {"max_off_nadir_deg", m.max_off_nadir_deg, 0, 90},
                 {"record_max_mb", static_cast<double>(m.record_max_mb), 0, far}});
}

std::string problem(const pose& m) {
  return out_of({{"w", m.w, -2, 2},
                 {"x", m.x, -2, 2},
                 {"y", m.y, -2, 2},
                 {"z", m.z, -2, 2},
                 {"rate_x_rad_s", m.rate_x_rad_s, -far, far},
                 {"rate_y_rad_s", m.rate_y_rad_s, -far, far},
                 {"rate_z_rad_s", m.rate_z_rad_s, -far, far},
                 {"latitude_deg", m.latitude_deg, -90, 90},
                 {"longitude_deg", m.longitude_deg, -180, 180},
                 {"height_m", m.height_m, -far, far},
                 {"attitude_sd_rad", m.attitude_sd_rad, 0, far},
                 {"position_sd_m", m.position_sd_m, 0, far},
                 {"height_sd_m", m.height_sd_m, 0, far}});
}

std::string problem(const want_picture& m) { return out_of({{"gap_ms", static_cast<double>(m.gap_ms), 20, 60'000}}); }

std::string problem(const status& m) {
  if (auto text = too_long({&m.reason, &m.unusable, &m.record_error, &m.model_error}); !text.empty())
    return text;
  return out_of({{"width_px", static_cast<double>(m.width_px), 0, max_side_px},
                 {"height_px", static_cast<double>(m.height_px), 0, max_side_px},
                 {"frames_per_s", m.frames_per_s, 0, far},
                 {"look_ms", m.look_ms, 0, far}});
}

std::string problem(const ground_place& m) {
  return out_of({{"latitude_deg", m.latitude_deg, -90, 90},
                 {"longitude_deg", m.longitude_deg, -180, 180},
                 {"variance_north_m2", m.variance_north_m2, 0, far},
                 {"variance_east_m2", m.variance_east_m2, 0, far},
                 {"covariance_m2", m.covariance_m2, -far, far},
                 {"size_m", m.size_m, 0, far}});
}

std::string problem(const candidate& m) {
  if (m.place)
    if (auto place = problem(*m.place); !place.empty())
      return place;
  return out_of({{"x_px", m.where.x_px, -max_side_px, max_side_px},
                 {"y_px", m.where.y_px, -max_side_px, max_side_px},
                 {"width_px", m.where.width_px, 0, max_side_px},
                 {"height_px", m.where.height_px, 0, max_side_px},
                 {"confidence", m.confidence, 0, 1},
                 {"speed_px_s", m.speed_px_s, 0, far}});
}

std::string problem(const candidates& m) {
  if (m.seen.size() > max_candidates)
    return std::to_string(m.seen.size()) + " candidates in one picture are too many";
  for (const auto& each : m.seen)
    if (auto its = problem(each); !its.empty())
      return its;
  return {};
}

// Of the kind with this number, which is its place in `message`.
template <std::size_t I = 0>
tl::expected<message, decode_error> read_body(std::size_t kind, const nlohmann::json& body) {
  if constexpr (I == std::variant_size_v<message>) {
    return tl::unexpected(decode_error{decode_errc::unknown_kind, "there is no message " + std::to_string(kind)});
  } else {
    if (kind != I)
      return read_body<I + 1>(kind, body);
    std::variant_alternative_t<I, message> result;
    if (const auto read = read_json(body, result); !read)
      return tl::unexpected(decode_error{decode_errc::unreadable, read.error().message()});
    return message(std::move(result));
  }
}

decode_error refusal(decode_errc code, std::string what) { return {code, std::move(what)}; }

} // namespace

std::string problem_of(const message& said) {
  return std::visit([](const auto& each) { return problem(each); }, said);
}

std::string clipped(std::string text) {
  text.resize(whole_characters(text, max_text_bytes));
  return text;
}

std::string encode(const message& said) {
  std::string body;
  std::visit([&body](const auto& each) { append_json_value(body, each); }, said);
  const auto length = static_cast<std::uint32_t>(body.size());
  std::string result{'g', 'e', static_cast<char>(protocol_version), static_cast<char>(said.index())};
  for (unsigned shift = 0; shift < 32; shift += 8)
    result += static_cast<char>((length >> shift) & 0xFFU);
  return result + body;
}

tl::expected<message, decode_error> decode(std::span<const std::byte> datagram) {
  if (datagram.size() < head_bytes)
    return tl::unexpected(refusal(decode_errc::too_short, std::to_string(datagram.size()) + " bytes are no message"));
  if (datagram.size() > max_datagram_bytes)
    return tl::unexpected(refusal(decode_errc::too_long, "a message is longer than may be"));
  std::array<std::uint8_t, head_bytes> head{};
  for (std::size_t i = 0; i < head_bytes; ++i)
    head.at(i) = std::to_integer<std::uint8_t>(datagram[i]);
  if (head[0] != 'g' || head[1] != 'e')
    return tl::unexpected(refusal(decode_errc::no_message, "it does not begin as a message"));
  if (head[2] != protocol_version)
    return tl::unexpected(refusal(decode_errc::wrong_version, "it is of version " + std::to_string(head[2]) +
                                                                  ", and here is version " +
                                                                  std::to_string(protocol_version)));
  const auto length =
      std::size_t{head[4]} | std::size_t{head[5]} << 8U | std::size_t{head[6]} << 16U | std::size_t{head[7]} << 24U;
  if (length != datagram.size() - head_bytes)
    return tl::unexpected(refusal(decode_errc::wrong_length, "its length is not that of its bytes"));
  const auto* const text = reinterpret_cast<const char*>(datagram.data()) + head_bytes; // bytes as characters
  const auto body = nlohmann::json::parse(text, text + length, nullptr, false);
  if (body.is_discarded())
    return tl::unexpected(refusal(decode_errc::unreadable, "its body is no JSON"));
  auto result = read_body(head[3], body);
  if (result)
    if (auto problem = problem_of(*result); !problem.empty())
      return tl::unexpected(refusal(decode_errc::impossible, std::move(problem)));
  return result;
}

} // namespace godwit::io::eyes
