#include "programs/godwitd/doctor/line_findings.hpp"

#include <algorithm>

#include "io/mavlink/enums.hpp"
#include "programs/common/link_advice.hpp"
#include "programs/godwitd/open_line.hpp"

namespace godwit::daemon::doctor {
namespace {

using io::mavlink::mav_autopilot;
using io::mavlink::number;

constexpr std::uint64_t damaged_share = 20; // one frame of so many: a radio at its limit, or a wrong baud rate

std::string autopilot_name(std::uint8_t autopilot) {
  if (autopilot == number(mav_autopilot::ardupilotmega))
    return "ArduPilot";
  if (autopilot == number(mav_autopilot::px4))
    return "PX4";
  return "an autopilot of kind " + std::to_string(autopilot) + ", which was not tried";
}

std::string name_of(const heard_sender& who) {
  return std::to_string(who.system) + "/" + std::to_string(who.component);
}

std::vector<heard_sender> autopilots_of(const heard_line& heard) {
  std::vector<heard_sender> result;
  std::ranges::copy_if(heard.senders, std::back_inserter(result),
                       [](const heard_sender& each) { return each.autopilot != number(mav_autopilot::invalid); });
  return result;
}

finding no_frames(const heard_line& heard, const io::link::uri& line) {
  if (heard.counted.v1_frames != 0)
    return {grade::problem, "autopilot", "Only MAVLink 1 arrives on " + line.text() + ".",
            programs::advice_for_mavlink_1};
  auto advice = heard.counted.bytes == 0 ? programs::advice_for_silence(line, heard.lasted, true)
                                         : programs::advice_for_noise(line, heard.counted.bytes);
  return {grade::problem, "autopilot", "No autopilot is heard on " + line.text() + ".", std::move(advice)};
}

finding nobody_flies(const heard_line& heard, const io::link::uri& line) {
  std::string names;
  for (const auto& each : heard.senders)
    names += (names.empty() ? "" : ", ") + name_of(each);
  return {grade::problem, "autopilot",
          "MAVLink arrives on " + line.text() + ", and no heartbeat of an autopilot" +
              (names.empty() ? "." : "; heartbeats come from " + names + "."),
          "Connect the line to the autopilot itself, or have the router pass its heartbeats on."};
}

finding judge_autopilots(const std::vector<heard_sender>& all, const line_expectation& wanted) {
  std::string names;
  for (const auto& each : all)
    names += (names.empty() ? "" : " and ") + std::to_string(each.system) + " (" + autopilot_name(each.autopilot) + ")";
  const auto expected = std::ranges::find(all, wanted.system, &heard_sender::system);
  if (wanted.system != 0 && expected == all.end())
    return {grade::problem, "autopilot",
            "Vehicle " + std::to_string(wanted.system) + " is expected (vehicle.system), and " + names + " is heard.",
            "Set vehicle.system to the vehicle that godwit is to fly, or 0 where there is one alone."};
  if (all.size() > 1 && wanted.system == 0)
    return {grade::problem, "autopilot", "More than one autopilot is heard: " + names + ".",
            "Set vehicle.system to the one that godwit is to fly."};
  return {grade::good, "autopilot", "Vehicle " + names + " is heard on " + wanted.line.text() + "."};
}

finding judge_signing(const std::vector<heard_sender>& all, const line_expectation& wanted) {
  const bool is_signed = std::ranges::any_of(all, &heard_sender::is_signed);
  if (is_signed && !wanted.has_key)
    return {grade::problem, "signing", "The autopilot signs, and no key is set: it refuses what godwit sends.",
            "Name the key's file in vehicle.key_file (--signing-key)."};
  if (!is_signed && wanted.has_key)
    return {grade::problem, "signing", "A key is set, and the autopilot does not sign: nothing of it is believed.",
            "Give it the key over a serial line with `godwitd ctl sign`, or take vehicle.key_file out."};
  if (is_signed)
    return {grade::good, "signing", "The autopilot signs."};
  const auto open = open_line(wanted.line, false);
  if (open.empty())
    return {grade::good, "signing", "The line has no key, and does not leave this vehicle."};
  return {grade::warning, "signing",
          "The line has no key: whoever is in the network of " + open + " can take the flight.",
          "Set vehicle.key_file, and give the autopilot the key with `godwitd ctl sign`."};
}

} // namespace

findings judge_line(const heard_line& heard, const line_expectation& wanted) {
  if (!heard.why_down.empty())
    return {{grade::problem, "line", "The line is not open: " + heard.why_down + ".",
             "See what is found above about the serial line, or check address and port of vehicle.uri."}};
  if (heard.counted.frames == 0)
    return {no_frames(heard, wanted.line)};
  const auto all = autopilots_of(heard);
  findings result{all.empty() ? nobody_flies(heard, wanted.line) : judge_autopilots(all, wanted)};
  if (!all.empty())
    result.push_back(judge_signing(all, wanted));
  if (heard.counted.bad_crc * damaged_share > heard.counted.frames + heard.counted.bad_crc)
    result.push_back({grade::warning, "line",
                      std::to_string(heard.counted.bad_crc) + " of " +
                          std::to_string(heard.counted.frames + heard.counted.bad_crc) + " frames arrive damaged.",
                      "Check cable, ground and baud rate; a radio needs a lower data rate or a better antenna."});
  return result;
}

} // namespace godwit::daemon::doctor
