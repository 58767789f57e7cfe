#include "programs/godwit-sim/vehicle/vehicle.hpp"

#include <utility>

#include "programs/godwit-sim/vehicle/vehicle_parts.hpp"

namespace godwit::sim {

vehicle::vehicle(const vehicle_settings& settings, std::int64_t now_ns, frame_sink send)
    : parts_(std::make_unique<parts>(settings, now_ns, std::move(send))) {}

vehicle::~vehicle() = default;

vehicle::line_number vehicle::add_line(frame_sink send, std::int64_t now_ns) {
  return parts_->add_line(std::move(send), now_ns);
}

void vehicle::on_frame(const io::mavlink::frame_view& frame, std::int64_t now_ns, line_number line) {
  parts_->on_frame(frame, now_ns, line);
}

void vehicle::on_time(std::int64_t now_ns) { parts_->on_time(now_ns); }

std::int64_t vehicle::next_deadline_ns() const { return parts_->next_deadline_ns(); }

void vehicle::reboot(std::int64_t now_ns) { parts_->reboot(now_ns); }

void vehicle::lose_position(bool lost, std::int64_t now_ns) { parts_->lose_position(lost, now_ns); }
void vehicle::block(bool is_blocked, std::int64_t now_ns) { parts_->block(is_blocked, now_ns); }

void vehicle::set_battery(double percent, std::int64_t now_ns) { parts_->set_battery(percent, now_ns); }

void vehicle::limit_distance(double metres) { parts_->limit_distance(metres); }

void vehicle::breach_fence(std::int64_t now_ns) { parts_->breach_fence(now_ns); }

void vehicle::say(std::string_view words, std::int64_t now_ns) { parts_->say(words, now_ns); }

void vehicle::refuse_command(std::uint16_t command, std::uint8_t result, int times) {
  parts_->refuse_command(command, result, times);
}

vehicle_picture vehicle::describe() const { return parts_->describe(); }

const std::vector<io::mavlink::mission_item_int>& vehicle::mission_items() const { return parts_->mission_items(); }

} // namespace godwit::sim
