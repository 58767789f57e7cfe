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

} // namespace godwit::trace_tool
