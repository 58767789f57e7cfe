// The parameters that a vehicle shows to ground stations: a list that is read, and of which some can be set.
//
// PARAM_REQUEST_LIST is answered at a bounded rate, one value each value_interval; a new list request starts the list
// again. PARAM_REQUEST_READ (by name or index) and PARAM_SET are answered with PARAM_VALUE; an unknown name or index
// with silence, as autopilots do. A value that can not be set is answered with the value that stays. Pure.
// Thread: one at a time. Source: MAVLink parameter protocol, PARAM_VALUE (22).
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/mavlink/messages/param.hpp"

namespace godwit::ground_port::vehicle_role {

inline constexpr std::uint8_t param_type_int32 = 6;  // MAV_PARAM_TYPE
inline constexpr std::uint8_t param_type_real32 = 9; // MAV_PARAM_TYPE

struct param {
  std::string name; // at most 16 characters
  float value = 0;  // of an integer: its value, which a float holds exactly up to 2^24
  std::uint8_t type = param_type_real32;
  bool can_be_set = false;
};

// How an int32 travels in the float of PARAM_VALUE: converted, as ArduPilot does, or with its bits, as PX4 does.
enum class param_encoding { as_value, as_bits };

class param_table {
public:
  static constexpr std::int64_t value_interval_ns = 1'000'000; // 1000 a second, as ArduPilot

  // So much of a list is given in one go when the caller comes late.
  static constexpr std::int64_t max_behind_ns = 50'000'000;

  explicit param_table(std::vector<param> params, param_encoding encoding = param_encoding::as_value)
      : params_(std::move(params)), encoding_(encoding) {}

  void on(const io::mavlink::param_request_list& m, std::int64_t now_ns);
  [[nodiscard]] std::optional<io::mavlink::param_value> on(const io::mavlink::param_request_read& m) const;
  // The answer. What was set is value_of(name) from now on. What is no number, or no int32 for a parameter that is one,
  // is not taken; neither is another type where integers travel as bits, since it would be misread.
  [[nodiscard]] std::optional<io::mavlink::param_value> on(const io::mavlink::param_set& m);

  // The next value of a list that is being given; nothing: none is due. Call it until it gives nothing.
  [[nodiscard]] std::optional<io::mavlink::param_value> due(std::int64_t now_ns);
  [[nodiscard]] std::int64_t next_due_ns() const { return next_ns_; }

  [[nodiscard]] const std::vector<param>& all() const { return params_; }
  // 0 for an unknown name.
  [[nodiscard]] float value_of(std::string_view name) const;

private:
  [[nodiscard]] io::mavlink::param_value value_at(std::size_t index) const;
  [[nodiscard]] std::optional<std::size_t> find(std::string_view name) const;
  [[nodiscard]] std::optional<float> number_in(const io::mavlink::param_set& m, const param& of) const;

  std::vector<param> params_;
  param_encoding encoding_;
  std::size_t next_ = 0;
  std::int64_t next_ns_ = std::numeric_limits<std::int64_t>::max();
};

} // namespace godwit::ground_port::vehicle_role
