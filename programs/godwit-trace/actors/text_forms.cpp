#include "programs/godwit-trace/actors/text_forms.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "io/fields/json_text.hpp"
#include "io/fields/utc_seconds.hpp"
#include "io/time_units.hpp"
#include "programs/common/printable.hpp"

namespace godwit::trace_tool {

namespace {

template <class... Args>
std::string formatted(const char* format, Args... args) {
  std::array<char, 128> text{};
  const int size = std::snprintf(text.data(), text.size(), format, args...); // NOLINT(*-vararg)
  return {text.data(), std::min(static_cast<std::size_t>(std::max(size, 0)), text.size() - 1)};
}

} // namespace

void append_utc_ns(std::string& out, std::int64_t at_ns) {
  auto seconds = at_ns / ns_per_s;
  auto fraction = at_ns % ns_per_s;
  if (fraction < 0) {
    --seconds;
    fraction += ns_per_s;
  }
  out += io::utc_seconds_text(std::chrono::sys_seconds(std::chrono::seconds(seconds)));
  out += formatted(".%09lldZ", static_cast<long long>(fraction));
}

std::string utc_ns(std::int64_t at_ns) {
  std::string result;
  append_utc_ns(result, at_ns);
  return result;
}

std::string duration_text(std::int64_t duration_ns) {
  struct unit {
    double ns;
    const char* name;
  };
  static constexpr std::array<unit, 3> units{{{1e9, "s"}, {1e6, "ms"}, {1e3, "us"}}};
  for (const auto& each : units)
    if (static_cast<double>(duration_ns) >= each.ns)
      return formatted("%.3g %s", static_cast<double>(duration_ns) / each.ns, each.name);
  return std::to_string(duration_ns) + " ns";
}

void append_member(std::string& out, std::string_view name, std::string_view text) {
  out.append(",\"").append(name).append("\":");
  io::append_json_string(out, text);
}

void append_printable(std::string& out, std::string_view text) { out += programs::one_line(text); }

paint::paint(bool is_terminal) : is_on_(is_terminal && std::getenv("NO_COLOR") == nullptr) {}

void append_line(std::string& out, const runtime::delivery& each, const runtime::name_table& names,
                 const paint& colours) {
  append_utc_ns(out, each.began_ns);
  out.append(" ").append(colours.actor());
  append_printable(out, names.name(each.actor));
  out.append("/").append(std::to_string(each.incarnation)).append(colours.end()).append(" <- ");
  append_printable(out, names.name(each.sender));
  out.append(" ").append(colours.type());
  append_printable(out, names.name(each.type));
  out.append(colours.end()).append(" #").append(std::to_string(each.id));
  if (each.cause != 0)
    out.append(" because #").append(std::to_string(each.cause));
  out.append(" ").append(duration_text(each.duration_ns));
  if (each.how != runtime::outcome::handled)
    out.append(" ").append(colours.bad()).append(io::name_of(each.how)).append(colours.end());
  out.append(" ").append(colours.faint());
  append_printable(out, each.oversize ? std::string_view("(too long for the trace)") : each.body);
  out.append(colours.end()).append("\n");
}

void append_json_line(std::string& out, const runtime::delivery& each, const runtime::name_table& names) {
  out += R"({"time":")";
  append_utc_ns(out, each.began_ns);
  out.append(R"(","time_ns":)").append(std::to_string(each.began_ns));
  out.append(R"(,"run":)").append(std::to_string(each.run)).append(R"(,"id":)").append(std::to_string(each.id));
  out.append(R"(,"cause":)").append(std::to_string(each.cause)).append(R"(,"actor":)");
  io::append_json_string(out, names.name(each.actor));
  out.append(R"(,"incarnation":)").append(std::to_string(each.incarnation)).append(R"(,"sender":)");
  io::append_json_string(out, names.name(each.sender));
  out += R"(,"type":)";
  io::append_json_string(out, names.name(each.type));
  out.append(R"(,"duration_ns":)").append(std::to_string(each.duration_ns));
  out.append(R"(,"outcome":")").append(io::name_of(each.how)).append("\"");
  if (each.oversize)
    out += R"(,"oversize":true)";
  else if (!each.body.empty())
    out.append(R"(,"message":)").append(each.body);
  out += '}';
}

std::string loss_sentence(const runtime::loss& each) {
  std::string result = each.file.empty() ? std::string() : each.file + ": ";
  result += each.what;
  if (each.records > 0)
    result += " (" + std::to_string(each.records) + " records)";
  if (each.bytes > 0)
    result +=
        ": " + std::to_string(each.bytes) + " bytes from offset " + std::to_string(each.offset) + " on are not read";
  else if (each.offset > 0)
    result += " at offset " + std::to_string(each.offset);
  if (each.kind == runtime::loss_kind::cut)
    result += "; it is being written, or its writer was killed";
  if (each.after_ns != 0 && each.is_hole)
    result += "; the newest record before that is of " + utc_ns(each.after_ns);
  return result;
}

void append_loss_json(std::string& out, const runtime::loss& each) {
  out.append(R"({"kind":")").append(io::name_of(each.kind)).append(R"(","run":)").append(std::to_string(each.run));
  out += R"(,"file":)";
  io::append_json_string(out, each.file);
  out.append(R"(,"offset":)").append(std::to_string(each.offset));
  out.append(R"(,"bytes":)").append(std::to_string(each.bytes));
  out.append(R"(,"records":)").append(std::to_string(each.records));
  out.append(R"(,"after_ns":)").append(std::to_string(each.after_ns)).append(R"(,"what":)");
  io::append_json_string(out, each.what);
  out.append(R"(,"is_hole":)").append(each.is_hole ? "true" : "false").append("}");
}

void text_table::append_to(std::string& out) const {
  std::vector<std::size_t> widths;
  for (std::size_t n = 0; n < columns_.size(); ++n) {
    auto width = columns_[n].title.size();
    for (const auto& each : rows_)
      width = std::max(width, each.at(n).size());
    widths.push_back(width);
  }
  const auto add_line = [&](const auto& text_of) {
    std::string line;
    for (std::size_t n = 0; n < columns_.size(); ++n) {
      const std::string& text = text_of(n);
      const std::string gap(widths[n] - text.size(), ' ');
      line += n == 0 ? "" : "  ";
      line += columns_[n].is_number ? gap + text : text + gap;
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + '\n';
  };
  add_line([this](std::size_t n) -> const std::string& { return columns_[n].title; });
  for (const auto& each : rows_)
    add_line([&each](std::size_t n) -> const std::string& { return each[n]; });
}

} // namespace godwit::trace_tool
