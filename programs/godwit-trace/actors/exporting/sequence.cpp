#include <algorithm>
#include <cctype>
#include <vector>

#include "programs/godwit-trace/actors/exporting/export_format.hpp"
#include "programs/godwit-trace/actors/text_forms.hpp"

namespace godwit::trace_tool {

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

} // namespace godwit::trace_tool
