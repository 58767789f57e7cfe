#include "programs/godwit-sim/host/fault.hpp"

#include <algorithm>
#include <cctype>
#include <limits>
#include <type_traits>

#include "io/mavlink/enums/command.hpp"
#include "programs/godwit-sim/text_forms.hpp"

namespace godwit::sim {
namespace {

namespace mavlink = io::mavlink;

constexpr std::uint64_t most_refusals = 1'000'000;
constexpr std::size_t max_said_bytes = 250; // five frames of STATUSTEXT

constexpr std::string_view forms =
    "; one of: faults loss=0.1,delay=15ms | cut | cut 5s | restore | reboot | gps lost | "
    "gps back | way blocked | way free | battery 20 | camera cut | camera back | say TEXT | "
    "refuse COMMAND=RESULT TIMES | accept "
    "COMMAND";

using parsed = tl::expected<fault::any, std::string>;

tl::unexpected<std::string> mistake(std::string_view text, std::string_view what) {
  return tl::make_unexpected(in_quotes(text) + " " + std::string(what));
}

// A number of the enum's size, or one of its names in capitals or not, with the prefix that the field uses or without.
template <class E>
std::optional<std::underlying_type_t<E>> read_enum(std::string_view text, std::string_view prefix) {
  using number_type = std::underlying_type_t<E>;
  if (const auto number = read_whole_number(text))
    return *number <= std::numeric_limits<number_type>::max() ? std::optional(static_cast<number_type>(*number))
                                                              : std::nullopt;
  std::string name(text);
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char each) { return std::tolower(each); });
  if (name.starts_with(prefix))
    name.erase(0, prefix.size());
  const auto value = io::value_of<E>(name);
  return value ? std::optional(static_cast<number_type>(*value)) : std::nullopt;
}

tl::expected<std::uint16_t, std::string> read_command(std::string_view text) {
  if (const auto command = read_enum<mavlink::mav_cmd>(text, "mav_cmd_"))
    return *command;
  return mistake(text, "is not a command: a number from 0 to 65535 or a name as MISSION_START");
}

parsed read_cut(std::string_view rest) {
  if (rest.empty())
    return fault::cut{};
  if (const auto time = read_duration(rest))
    return fault::cut{*time};
  return mistake(rest, "is not a time for which a line is cut, such as 5s");
}

parsed read_gps(std::string_view rest) {
  if (rest == "lost" || rest == "back")
    return fault::gps{rest == "lost"};
  return mistake(rest, "does not name what happens to the GPS: lost or back");
}

parsed read_way(std::string_view rest) {
  if (rest == "blocked" || rest == "free")
    return fault::way{rest == "blocked"};
  return mistake(rest, "does not name the state of the way: blocked or free");
}

parsed read_battery(std::string_view rest) {
  const auto percent = read_number(rest);
  if (percent && *percent >= 0 && *percent <= 100)
    return fault::battery{*percent};
  return mistake(rest, "is not a charge of a battery: 0 to 100 percent");
}

parsed read_camera(std::string_view rest) {
  if (rest == "cut" || rest == "back")
    return fault::camera{rest == "cut"};
  return mistake(rest, "does not name what happens to the camera: cut or back");
}

parsed read_say(std::string_view rest) {
  if (!rest.empty() && rest.size() <= max_said_bytes)
    return fault::say{std::string(rest)};
  return mistake(rest, "is no text of an autopilot: 1 to 250 bytes");
}

parsed read_accept(std::string_view rest) {
  return read_command(rest).map([](std::uint16_t command) { return fault::any(fault::refuse{command, 0, 0}); });
}

struct word {
  std::string_view name;
  parsed (*read)(std::string_view rest);
};
constexpr word words[] = {{"faults",
                           [](std::string_view rest) -> parsed {
                             return parse_line_faults(rest).map(
                                 [](const line_faults& faults) { return fault::any(fault::set_line{faults}); });
                           }},
                          {"cut", read_cut},
                          {"gps", read_gps},
                          {"way", read_way},
                          {"battery", read_battery},
                          {"camera", read_camera},
                          {"say", read_say},
                          {"refuse",
                           [](std::string_view rest) -> parsed {
                             return parse_refusal(rest).map(
                                 [](const fault::refuse& refusal) { return fault::any(refusal); });
                           }},
                          {"accept", read_accept}};

struct for_people {
  std::string operator()(const fault::set_line& it) const { return "the line is set to " + text_of(it.faults); }
  std::string operator()(const fault::cut& it) const {
    const auto seconds = it.time ? static_cast<double>(it.time->count()) / 1e9 : 0;
    return "the line is cut" + (it.time ? " for " + shortest(seconds) + " s" : std::string());
  }
  std::string operator()(const fault::restore&) const { return "the line is restored"; }
  std::string operator()(const fault::reboot&) const { return "the autopilot is rebooted"; }
  std::string operator()(const fault::gps& it) const { return it.is_lost ? "the GPS is lost" : "the GPS is back"; }
  std::string operator()(const fault::way& it) const {
    return it.is_blocked ? "something holds the vehicle where it is" : "nothing holds the vehicle any more";
  }
  std::string operator()(const fault::battery& it) const {
    return "the battery is set to " + shortest(it.percent) + " %";
  }
  std::string operator()(const fault::camera& it) const {
    return it.is_cut ? "the camera sends nothing" : "the camera is back";
  }
  std::string operator()(const fault::say& it) const { return "the autopilot reports: " + it.words; }
  std::string operator()(const fault::refuse& it) const {
    const auto command = "the command " + std::to_string(it.command);
    if (it.times == 0)
      return command + " is no longer refused";
    const auto often = it.times < 0 ? std::string() : ", " + std::to_string(it.times) + " times";
    return command + " is answered with " + std::to_string(it.result) + often;
  }
};

} // namespace

tl::expected<fault::refuse, std::string> parse_refusal(std::string_view text) {
  const auto space = text.find(' ');
  const auto what = text.substr(0, space);
  const auto equals = what.find('=');
  fault::refuse result{0, static_cast<std::uint8_t>(mavlink::mav_result::denied), -1};
  const auto command = read_command(what.substr(0, equals));
  if (!command)
    return tl::make_unexpected(command.error());
  result.command = *command;
  if (equals != std::string_view::npos) {
    const auto answer = read_enum<mavlink::mav_result>(what.substr(equals + 1), "mav_result_");
    if (!answer)
      return mistake(what.substr(equals + 1), "is not an answer: a number from 0 to 255 or a name as DENIED");
    result.result = *answer;
  }
  if (space != std::string_view::npos) {
    const auto times = read_whole_number(trimmed(text.substr(space)));
    if (!times || *times > most_refusals)
      return mistake(trimmed(text.substr(space)), "does not name how often, such as 2");
    result.times = static_cast<int>(*times);
  }
  return result;
}

tl::expected<fault::any, std::string> parse_fault(std::string_view text) {
  text = trimmed(text);
  const auto space = std::min(text.find(' '), text.size());
  const auto name = text.substr(0, space);
  const auto rest = trimmed(text.substr(space));
  if (text == "restore")
    return fault::restore{};
  if (text == "reboot")
    return fault::reboot{};
  for (const auto& each : words)
    if (each.name == name)
      return each.read(rest);
  return mistake(text, "is not a fault" + std::string(forms));
}

tl::expected<timed_fault, std::string> parse_timed_fault(std::string_view text) {
  const auto equals = text.find('=');
  const auto time = read_duration(trimmed(text.substr(0, equals)));
  if (equals == std::string_view::npos || !time)
    return mistake(text, "is not a time and a fault, such as \"30s=gps lost\"");
  auto what = parse_fault(text.substr(equals + 1));
  if (!what)
    return tl::make_unexpected(std::move(what.error()));
  return timed_fault{*time, *std::move(what)};
}

std::string sentence_of(const fault::any& what) { return std::visit(for_people(), what); }

} // namespace godwit::sim
