#include "actors/ground_port/vehicle_role/param_table.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace godwit::ground_port::vehicle_role {

namespace {

using param_id = std::array<char, 16>;

std::string_view text_of(const param_id& id) {
  return {id.data(), static_cast<std::size_t>(std::find(id.begin(), id.end(), '\0') - id.begin())};
}

param_id id_of(std::string_view name) {
  param_id result{};
  std::copy_n(name.begin(), std::min(name.size(), result.size()), result.begin());
  return result;
}

bool is_int32(float value) { return value >= -0x1p31F && value < 0x1p31F; }

} // namespace

void param_table::on(const io::mavlink::param_request_list&, std::int64_t now_ns) {
  next_ = 0;
  next_ns_ = params_.empty() ? std::numeric_limits<std::int64_t>::max() : now_ns;
}

std::optional<io::mavlink::param_value> param_table::on(const io::mavlink::param_request_read& m) const {
  if (m.param_index < 0) {
    const auto found = find(text_of(m.param_id));
    return found ? std::optional(value_at(*found)) : std::nullopt;
  }
  const auto index = static_cast<std::size_t>(m.param_index);
  return index < params_.size() ? std::optional(value_at(index)) : std::nullopt;
}

std::optional<io::mavlink::param_value> param_table::on(const io::mavlink::param_set& m) {
  const auto found = find(text_of(m.param_id));
  if (!found)
    return std::nullopt;
  auto& each = params_[*found];
  if (const auto number = number_in(m, each); number && each.can_be_set)
    each.value = *number;
  return value_at(*found);
}

std::optional<float> param_table::number_in(const io::mavlink::param_set& m, const param& of) const {
  if (encoding_ == param_encoding::as_bits) {
    if (m.param_type != of.type)
      return std::nullopt;
    if (of.type == param_type_int32)
      return static_cast<float>(std::bit_cast<std::int32_t>(m.param_value));
  }
  if (!std::isfinite(m.param_value))
    return std::nullopt;
  if (of.type != param_type_int32)
    return m.param_value;
  return is_int32(m.param_value) ? std::optional(std::trunc(m.param_value)) : std::nullopt;
}

std::optional<io::mavlink::param_value> param_table::due(std::int64_t now_ns) {
  if (now_ns < next_ns_)
    return std::nullopt;
  const auto result = value_at(next_++);
  if (next_ == params_.size())
    next_ns_ = std::numeric_limits<std::int64_t>::max();
  else
    next_ns_ = std::max(next_ns_ + value_interval_ns, now_ns - max_behind_ns);
  return result;
}

float param_table::value_of(std::string_view name) const {
  const auto found = find(name);
  return found ? params_[*found].value : 0.0F;
}

io::mavlink::param_value param_table::value_at(std::size_t index) const {
  const auto& each = params_[index];
  const bool in_bits = encoding_ == param_encoding::as_bits && each.type == param_type_int32 && is_int32(each.value);
  return {.param_id = id_of(each.name),
          .param_value = in_bits ? std::bit_cast<float>(static_cast<std::int32_t>(each.value)) : each.value,
          .param_type = each.type,
          .param_count = static_cast<std::uint16_t>(params_.size()),
          .param_index = static_cast<std::uint16_t>(index)};
}

std::optional<std::size_t> param_table::find(std::string_view name) const {
  const auto found = std::find_if(params_.begin(), params_.end(), [&](const param& p) { return p.name == name; });
  return found == params_.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - params_.begin()));
}

} // namespace godwit::ground_port::vehicle_role
