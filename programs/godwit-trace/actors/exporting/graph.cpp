#include <map>

#include "io/fields/json_text.hpp"
#include "programs/godwit-trace/actors/exporting/export_format.hpp"

namespace godwit::trace_tool {

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

} // namespace godwit::trace_tool
