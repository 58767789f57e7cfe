#include "programs/godwit-trace/plan_transfer.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <iterator>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "io/fields/json_text.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/waypoint_file/waypoint_file.hpp"
#include "io/time_units.hpp"

namespace godwit::trace_tool {

namespace {

using vehicle_link::effects;
using vehicle_link::transfer::outcome;
using vehicle_link::transfer::verdict;

constexpr std::uint64_t our_request = 1;

bool is_readable(int descriptor) {
  pollfd watched{descriptor, POLLIN, 0};
  return ::poll(&watched, 1, 0) > 0;
}

effects begin(vehicle_link::core& core, const plan_request& what) {
  struct starter {
    vehicle_link::core& core;
    effects operator()(const vehicle_link::upload_plan& m) const {
      return core.on_upload(our_request, m, vehicle_session::now());
    }
    effects operator()(const vehicle_link::download_plan& m) const {
      return core.on_download(our_request, m, vehicle_session::now());
    }
    effects operator()(const vehicle_link::clear_plan& m) const {
      return core.on_clear(our_request, m, vehicle_session::now());
    }
  };
  return std::visit(starter{core}, what);
}

// Nothing: the vehicle is there.
std::optional<std::string> wait_for_vehicle(vehicle_session& session, const plan_transfer_options& options, int stop) {
  const auto until_ns = vehicle_session::now().monotonic_ns + options.wait_for_vehicle.count() * ns_per_ms;
  for (;;) {
    (void)session.next(until_ns, stop);
    const auto now = vehicle_session::now();
    if (session.core().describe(now).connected)
      return std::nullopt;
    if (is_readable(stop))
      return "stopped before a vehicle was found";
    if (now.monotonic_ns >= until_ns) {
      const auto why = session.core().health(now).reason;
      const auto& link = session.link_status();
      const bool says_more = link.phase != io::link::link_phase::up && link.reason != why;
      return says_more ? why + "; the link: " + link.reason : why;
    }
  }
}

bool is_home(const io::mavlink::mission_item_int& item) {
  using io::mavlink::mav_frame;
  using io::mavlink::number;
  return item.command == number(io::mavlink::mav_cmd::nav_waypoint) &&
         (item.frame == number(mav_frame::global) || item.frame == number(mav_frame::global_int));
}

// An ArduPilot puts its own home in the place of the first item, whatever that is. Nothing: none is lost.
std::optional<std::string> why_first_item_is_lost(const vehicle_link::connection& vehicle, const plan_request& what) {
  const auto* const upload = std::get_if<vehicle_link::upload_plan>(&what);
  if (upload == nullptr || upload->mission_type != io::mavlink::mav_mission_type::mission || upload->items.empty() ||
      vehicle.autopilot != io::mavlink::number(io::mavlink::mav_autopilot::ardupilotmega) ||
      is_home(upload->items.front()))
    return std::nullopt;
  return "nothing is sent: the vehicle is an ArduPilot, which puts its home in the place of the first item, and this "
         "plan begins with command " +
         std::to_string(upload->items.front().command) +
         ", which would be lost. Put a line of home in front of it (a NAV_WAYPOINT in frame 0), and count the indexes "
         "on";
}

outcome transfer(vehicle_session& session, const plan_transfer_options& options, console& to, int stop) {
  transfer_progress bar(to);
  bool is_cancelled = false;
  auto told = session.carry_out(begin(session.core(), options.what));
  for (;;) {
    for (auto& each : told) {
      if (auto* over = std::get_if<vehicle_link::resolved_transfer>(&each)) {
        bar.finish();
        return std::move(over->outcome);
      }
      if (const auto* news = std::get_if<vehicle_link::announcement>(&each))
        if (const auto* advanced = std::get_if<vehicle_link::transfer::progress>(news))
          bar.show(*advanced);
    }
    if (!is_cancelled && is_readable(stop)) {
      is_cancelled = true;
      told = session.carry_out(session.core().on_cancel_transfer(vehicle_session::now()));
      continue;
    }
    // After a cancel STOP stays readable, and would end each wait at once.
    told = session.next(INT64_MAX, is_cancelled ? -1 : stop);
  }
}

std::string seconds(std::int64_t ns) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3f s", static_cast<double>(ns) * 1e-9);
  return text.data();
}

std::string proof_text(const outcome& how) {
  switch (how.proof) {
  case vehicle_link::transfer::proof::acknowledged:
    return "acknowledged";
  case vehicle_link::transfer::proof::counted:
    return "acknowledged, and the vehicle holds as many items";
  case vehicle_link::transfer::proof::plan_id:
    return "the vehicle has a new plan of as many items";
  case vehicle_link::transfer::proof::read_back:
    return "read back and the same";
  case vehicle_link::transfer::proof::none:
    break;
  }
  return "done";
}

std::string sentence(const plan_request& what, const outcome& how, const std::string& file) {
  const auto took = " in " + seconds(how.duration_ns);
  if (std::holds_alternative<vehicle_link::clear_plan>(what))
    return "cleared" + took;
  if (std::holds_alternative<vehicle_link::download_plan>(what))
    return "downloaded " + std::to_string(how.items.size()) + " items" + took + ", written to " + file;
  auto text = "uploaded " + std::to_string(std::get<vehicle_link::upload_plan>(what).items.size()) + " items" + took +
              ": " + proof_text(how);
  if (how.effort.items_resent != 0)
    text += "; " + std::to_string(how.effort.items_resent) + " items were sent again";
  if (how.plan_id && *how.plan_id != 0)
    text += "; plan id " + std::to_string(*how.plan_id);
  return text;
}

exit_code report(const plan_transfer_options& options, const outcome& how, console& to) {
  if (options.json)
    to.out.text() += io::to_json(how) + '\n';
  if (how.verdict != verdict::accepted) {
    to.say(std::string(io::name_of(how.verdict)) + ": " + how.reason);
    return exit_code::failed;
  }
  if (std::holds_alternative<vehicle_link::download_plan>(options.what))
    if (const auto saved = io::mavlink::save_waypoint_file(options.save_to, how.items); !saved) {
      to.say(saved.error().message());
      return exit_code::failed;
    }
  if (!options.json)
    to.out.text() += sentence(options.what, how, options.save_to) + '\n';
  return exit_code::ok;
}

} // namespace

exit_code run_plan_transfer(const plan_transfer_options& options, console& to, int stop) {
  vehicle_session session(options.link, options.signing);
  if (const auto opened = session.open(options.where); !opened) {
    to.say(opened.error());
    return exit_code::usage;
  }
  if (const auto why = wait_for_vehicle(session, options, stop)) {
    to.say(*why);
    return exit_code::failed;
  }
  const auto vehicle = session.core().describe(vehicle_session::now());
  if (const auto why = why_first_item_is_lost(vehicle, options.what)) {
    to.say(*why);
    return exit_code::failed;
  }
  return report(options, transfer(session, options, to, stop), to);
}

transfer_progress::transfer_progress(console& to) : to_(to), draws_(::isatty(STDERR_FILENO) != 0) {}

void transfer_progress::show(const vehicle_link::transfer::progress& how_far) {
  if (!draws_ || how_far.total == 0)
    return;
  const auto filled = static_cast<std::size_t>(width * how_far.done / std::max<int>(how_far.total, 1));
  to_.words.text() += "\r[" + std::string(filled, '#') + std::string(width - filled, ' ') + "] item " +
                      std::to_string(how_far.done) + " of " + std::to_string(how_far.total) + ' ';
  to_.words.flush();
  is_drawn_ = true;
}

void transfer_progress::finish() {
  if (!is_drawn_)
    return;
  to_.words.text() += "\r\033[K";
  to_.words.flush();
  is_drawn_ = false;
}

namespace {

std::int64_t since_epoch_ns(auto time) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
}

void append(vehicle_link::effects& to, vehicle_link::effects more) {
  to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

} // namespace

vehicle_session::vehicle_session(const vehicle_link::settings& configured,
                                 const vehicle_link::signing_settings& signing)
    : core_(configured, signing, {}), descriptor_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (descriptor_ < 0)
    throw std::system_error(errno, std::generic_category(), "eventfd");
}

vehicle_session::~vehicle_session() {
  link_.reset(); // its thread wakes us through the descriptor
  ::close(descriptor_);
}

vehicle_link::instant vehicle_session::now() {
  return {since_epoch_ns(std::chrono::steady_clock::now()), since_epoch_ns(std::chrono::system_clock::now())};
}

void vehicle_session::wake() const {
  const std::uint64_t one = 1;
  (void)!::write(descriptor_, &one, sizeof one); // it can only be full, and then it is readable already
}

tl::expected<void, std::string> vehicle_session::open(const io::link::uri& where) {
  io::link::link_callbacks callbacks;
  callbacks.received = [this](io::link::peer_id peer, std::span<const std::byte> bytes, bool is_datagram) {
    if (incoming_.put(peer, bytes, is_datagram))
      wake();
  };
  callbacks.changed = [this](const io::link::link_status& status) {
    if (incoming_.put(status))
      wake();
  };
  auto opened = io::link::open_link(where, std::move(callbacks));
  if (!opened)
    return tl::make_unexpected(opened.error());
  link_ = std::move(*opened);
  return {};
}

void vehicle_session::wait(std::int64_t until_ns, int stop) const {
  const auto left_ns = std::clamp<std::int64_t>(until_ns - now().monotonic_ns, 0, 1'000'000'000);
  const timespec left{left_ns / 1'000'000'000, left_ns % 1'000'000'000};
  pollfd watched[] = {{descriptor_, POLLIN, 0}, {stop, POLLIN, 0}};
  (void)::ppoll(watched, std::size(watched), &left, nullptr); // interrupted: the caller looks again
  std::uint64_t count = 0;
  (void)!::read(descriptor_, &count, sizeof count);
}

vehicle_link::effects vehicle_session::next(std::int64_t until_ns, int stop) {
  wait(std::min(until_ns, core_.next_deadline_ns()), stop);
  vehicle_link::effects told;
  while (const auto arrived = incoming_.take())
    append(told, carry_out(std::visit([this](const auto& what) { return take(what); }, *arrived)));
  if (now().monotonic_ns >= core_.next_deadline_ns())
    append(told, carry_out(core_.on_time(now())));
  return told;
}

vehicle_link::effects vehicle_session::take(const io::link::link_status& what) {
  status_ = what;
  return core_.on_link(what, now());
}

vehicle_link::effects vehicle_session::take(const io::link::arrival& what) {
  return core_.on_bytes(what.peer, what.is_datagram, what.bytes, now());
}

vehicle_link::effects vehicle_session::carry_out(vehicle_link::effects wanted) {
  vehicle_link::effects told;
  for (auto& each : wanted)
    if (const auto* out = std::get_if<vehicle_link::transmission>(&each))
      link_->send(out->frame.span(), out->to);
    else
      told.push_back(std::move(each));
  return told;
}

} // namespace godwit::trace_tool
