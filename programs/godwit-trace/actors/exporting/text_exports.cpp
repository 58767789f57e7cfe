#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <map>
#include <set>
#include <unordered_map>
#include <vector>

#include "io/fields/json_text.hpp"
#include "io/time_units.hpp"
#include "programs/godwit-trace/actors/exporting/export_format.hpp"
#include "programs/godwit-trace/actors/text_forms.hpp"

namespace godwit::trace_tool {

namespace {

void append_quoted(std::string& out, std::string_view text) {
  out += '"';
  for (const char c : text)
    out.append(c == '"' ? 2 : 1, c);
  out += '"';
}

class csv final : public exporter {
public:
  csv(const runtime::name_table& names, std::uint64_t limit) : names_(names), limit_(limit) {}

  void begin(std::string& out) override {
    out += "time,time_ns,run,id,cause,actor,incarnation,sender,type,duration_ns,outcome,message\r\n";
  }
  void take(std::string& out, const runtime::delivery& each) override {
    if (!has_room(limit_))
      return;
    append_utc_ns(out, each.began_ns);
    out.append(",").append(std::to_string(each.began_ns)).append(",").append(std::to_string(each.run));
    out.append(",").append(std::to_string(each.id)).append(",").append(std::to_string(each.cause)).append(",");
    append_quoted(out, names_.name(each.actor));
    out.append(",").append(std::to_string(each.incarnation)).append(",");
    append_quoted(out, names_.name(each.sender));
    out += ',';
    append_quoted(out, names_.name(each.type));
    out.append(",").append(std::to_string(each.duration_ns)).append(",").append(io::name_of(each.how)).append(",");
    append_quoted(out, each.body);
    out += "\r\n";
  }
  void end(std::string&) override {}

private:
  const runtime::name_table& names_;
  std::uint64_t limit_;
};

} // namespace

std::unique_ptr<exporter> make_csv(const runtime::name_table& names, std::uint64_t limit) {
  return std::make_unique<csv>(names, limit);
}

namespace {

constexpr double ns_in_a_second = 1e9;

// An edge for each sender, actor and type, the most frequent types first in its label. The limit is one of edges.
class graph final : public exporter {
public:
  graph(const runtime::name_table& names, std::uint64_t limit) : names_(names), limit_(limit) {}

  void begin(std::string&) override {}
  void take(std::string&, const runtime::delivery& each) override {
    first_ns_ = std::min(first_ns_, each.began_ns);
    last_ns_ = std::max(last_ns_, each.ended_ns());
    ++edges_[{each.sender, each.actor}][each.type];
  }
  void end(std::string& out) override {
    out += "digraph actors {\n  rankdir=LR;\n  node [shape=box, style=rounded, fontname=\"sans-serif\"];\n"
           "  edge [fontname=\"sans-serif\", fontsize=10];\n";
    for (const auto& [between, types] : edges_)
      append_edge(out, names_.name(between.first), names_.name(between.second), types);
    out += "}\n";
  }

private:
  void append_edge(std::string& out, const std::string& from, const std::string& to,
                   const std::map<std::uint32_t, std::uint64_t>& types) {
    constexpr std::size_t max_named = 4;
    std::multimap<std::uint64_t, std::uint32_t, std::greater<>> by_count;
    std::uint64_t sum = 0;
    for (const auto& [type, count] : types) {
      by_count.emplace(count, type);
      sum += count;
    }
    if (!has_room(limit_))
      return;
    std::string label = rate_text(sum);
    std::size_t named = 0;
    for (const auto& [count, type] : by_count) {
      if (named++ == max_named) {
        label += "\n...";
        break;
      }
      label += '\n' + names_.name(type) + ' ' + rate_text(count);
    }
    out += "  ";
    io::append_json_string(out, from);
    out += " -> ";
    io::append_json_string(out, to);
    out += " [label=";
    io::append_json_string(out, label);
    out += "];\n";
  }
  [[nodiscard]] std::string rate_text(std::uint64_t count) const {
    const auto seconds = static_cast<double>(last_ns_ - first_ns_) / ns_in_a_second;
    constexpr double tenth = 10;
    if (seconds <= 0)
      return std::to_string(count);
    const auto tenths = static_cast<std::uint64_t>(static_cast<double>(count) / seconds * tenth + 0.5);
    return std::to_string(tenths / 10) + '.' + std::to_string(tenths % 10) + "/s";
  }

  const runtime::name_table& names_;
  std::uint64_t limit_;
  std::int64_t first_ns_ = INT64_MAX;
  std::int64_t last_ns_ = INT64_MIN;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::map<std::uint32_t, std::uint64_t>> edges_;
};

} // namespace

std::unique_ptr<exporter> make_graph(const runtime::name_table& names, std::uint64_t limit) {
  return std::make_unique<graph>(names, limit);
}

namespace {

// Text in a diagram: `;` and `#` have meanings of their own there.
std::string plain(std::string_view text) {
  std::string result(text);
  std::ranges::replace_if(
      result, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '_'; }, ' ');
  return result;
}

class sequence final : public exporter {
public:
  sequence(const runtime::name_table& names, std::uint64_t limit) : names_(names), limit_(limit) {}

  void begin(std::string& out) override { out += "sequenceDiagram\n"; }
  void take(std::string& out, const runtime::delivery& each) override {
    if (!has_room(limit_))
      return;
    const auto from = participant(out, each.sender);
    const auto to = participant(out, each.actor);
    const bool is_well = each.how == runtime::outcome::handled;
    out.append("  ").append(from).append(is_well ? "->>" : "-x").append(to).append(": ");
    out.append(plain(names_.name(each.type))).append(" ").append(plain(duration_text(each.duration_ns)));
    if (!is_well)
      out.append(" ").append(io::name_of(each.how));
    out += '\n';
  }
  void end(std::string&) override {}

private:
  std::string participant(std::string& out, std::uint32_t name) {
    auto id = "a" + std::to_string(name);
    if (std::ranges::find(known_, name) == known_.end()) {
      known_.push_back(name);
      out.append("  participant ").append(id).append(" as ").append(plain(names_.name(name))).append("\n");
    }
    return id;
  }

  const runtime::name_table& names_;
  std::uint64_t limit_;
  std::vector<std::uint32_t> known_;
};

} // namespace

std::unique_ptr<exporter> make_sequence(const runtime::name_table& names, std::uint64_t limit) {
  return std::make_unique<sequence>(names, limit);
}

// Source: "Trace Event Format", Google, 2016; flow events "s" and "f" bind to the slice around their time.

namespace {

// Microseconds with nanoseconds after the point, as the format wants them. A double of so large a number is not exact.
std::string microseconds(std::int64_t ns) {
  std::array<char, 64> text{};
  const int size =
      std::snprintf(text.data(), text.size(), "%lld.%03lld", static_cast<long long>(ns / ns_per_us), // NOLINT(*-vararg)
                    static_cast<long long>(ns % ns_per_us));
  return {text.data(), static_cast<std::size_t>(std::max(size, 0))};
}

// One process for each run, one thread for each actor. A delivery is a slice, and where its cause is shown too, an
// arrow from there.
class perfetto final : public exporter {
public:
  perfetto(const runtime::name_table& names, std::uint64_t limit) : names_(names), limit_(limit) {}

  void begin(std::string& out) override { out += R"({"displayTimeUnit":"ns","traceEvents":[)"; }
  void take(std::string& out, const runtime::delivery& each) override {
    if (!has_room(limit_))
      return;
    if (each.run != run_ || begin_ns_ == 0) {
      run_ = each.run;
      shown_.clear();
      begin_ns_ = begin_ns_ == 0 ? each.began_ns : begin_ns_;
      named_.clear();
      name(out, "process_name", 0, "godwitd, run " + std::to_string(run_));
    }
    if (named_.insert(each.actor).second)
      name(out, "thread_name", each.actor + 1, names_.name(each.actor));
    append_slice(out, each);
    append_arrow(out, each);
  }
  void end(std::string& out) override { out += "\n]}\n"; }

private:
  void event(std::string& out, const char* phase, std::uint32_t thread) {
    out += is_first_ ? "\n" : ",\n";
    is_first_ = false;
    out.append(R"({"ph":")").append(phase).append(R"(","pid":)").append(std::to_string(run_));
    out.append(R"(,"tid":)").append(std::to_string(thread));
  }
  void name(std::string& out, const char* what, std::uint32_t thread, const std::string& value) {
    event(out, "M", thread);
    out.append(R"(,"name":")").append(what).append(R"(","args":{"name":)");
    io::append_json_string(out, value);
    out += "}}";
  }
  void append_slice(std::string& out, const runtime::delivery& each) {
    event(out, "X", each.actor + 1);
    out.append(R"(,"ts":)").append(microseconds(each.began_ns - begin_ns_));
    out.append(R"(,"dur":)").append(microseconds(each.duration_ns)).append(R"(,"name":)");
    io::append_json_string(out, names_.name(each.type));
    out.append(R"(,"cat":")")
        .append(io::name_of(each.how))
        .append(R"(","args":{"id":)")
        .append(std::to_string(each.id));
    out.append(R"(,"cause":)").append(std::to_string(each.cause)).append(R"(,"sender":)");
    io::append_json_string(out, names_.name(each.sender));
    out.append(R"(,"incarnation":)").append(std::to_string(each.incarnation));
    out.append(R"(,"unix_ns":)").append(std::to_string(each.began_ns));
    if (!each.body.empty())
      out.append(R"(,"message":)").append(each.body);
    out += "}}";
  }
  void append_arrow(std::string& out, const runtime::delivery& each) {
    const auto cause = shown_.find(each.cause);
    if (each.cause != 0 && cause != shown_.end() && each.sender != each.actor) {
      const auto number = std::to_string(++arrows_);
      event(out, "s", cause->second.actor + 1);
      out.append(R"(,"cat":"cause","name":"cause","id":)").append(number);
      out.append(R"(,"ts":)").append(microseconds(cause->second.began_ns - begin_ns_)).append("}");
      event(out, "f", each.actor + 1);
      out.append(R"(,"cat":"cause","name":"cause","bp":"e","id":)").append(number);
      out.append(R"(,"ts":)").append(microseconds(each.began_ns - begin_ns_)).append("}");
    }
    if (each.id != 0)
      shown_[each.id] = {each.actor, each.began_ns};
  }

  struct place {
    std::uint32_t actor = 0;
    std::int64_t began_ns = 0;
  };
  const runtime::name_table& names_;
  std::uint64_t limit_;
  bool is_first_ = true;
  std::uint64_t run_ = 0;
  std::int64_t begin_ns_ = 0; // of the first delivery: readers want small numbers
  std::uint64_t arrows_ = 0;
  std::set<std::uint32_t> named_;
  std::unordered_map<std::uint64_t, place> shown_; // by id; as many as the limit lets through
};

} // namespace

std::unique_ptr<exporter> make_perfetto(const runtime::name_table& names, std::uint64_t limit) {
  return std::make_unique<perfetto>(names, limit);
}

} // namespace godwit::trace_tool
